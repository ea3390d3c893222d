// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/text/document.hpp"

namespace quadrille::discrete {

using text::Checker;
using text::Document;
using text::DocumentBuilder;
using text::parse_json;
using text::parse_yaml;

}  // namespace quadrille::discrete
