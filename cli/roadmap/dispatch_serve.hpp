// SPDX-License-Identifier: MIT
#pragma once

#include "frame/exit_codes.hpp"
#include "quadrille/input/roadmap.hpp"
#include "roadmap/dispatch_roadmap.hpp"

namespace quadrille::cli {

/// Reads requests from standard input, one JSON object per line, and answers each with one line
/// (docs/dispatch.md#one-line-in-one-line-out), until the input ends. What is wrong with a line is
/// its answer, and the next one is read.
[[nodiscard]] ExitCode serve_dispatcher(const DispatchArguments& arguments,
                                        const input::RoadmapInput& input);

}  // namespace quadrille::cli
