// SPDX-License-Identifier: MIT
#pragma once

#include "fleets/dispatch.hpp"
#include "fleets/live_fleet.hpp"
#include "frame/exit_codes.hpp"
#include "quadrille/text/names.hpp"

namespace quadrille::cli {

/// Reads requests from standard input, one JSON object per line, and answers each with one line
/// (docs/dispatch.md#one-line-in-one-line-out), until the input ends. What is wrong with a line is
/// its answer, and the next one is read.
[[nodiscard]] ExitCode serve(const DispatchArguments& arguments, const text::Names& names,
                             LiveFleet& fleet);

}  // namespace quadrille::cli
