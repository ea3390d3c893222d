// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "answers/report.hpp"
#include "frame/output.hpp"
#include "quadrille/continuous/second_opinion.hpp"

namespace quadrille::cli {

/// The line "fcl" of the human output.
[[nodiscard]] std::string describe_opinion(const continuous::Instance& instance,
                                           const continuous::SecondOpinion& opinion);
/// The key "second_opinion" of the JSON, documented in docs/cli.md.
[[nodiscard]] Json opinion_json(const continuous::Instance& instance,
                                const continuous::SecondOpinion& opinion);

}  // namespace quadrille::cli
