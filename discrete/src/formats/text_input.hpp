// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/text/text_input.hpp"

namespace quadrille::discrete {

using text::finish_output;
using text::in_quotes;
using text::LineReader;
using text::Natural;
using text::NumberFault;
using text::open_input;
using text::parse_natural;
using text::printable;
using text::read_all;

}  // namespace quadrille::discrete
