// SPDX-License-Identifier: MIT
#include "quadrille/solve/frame.hpp"

namespace quadrille::solve {

std::optional<Error> check_numbers(const Choices& choices) {
  const auto refuse = [](std::string message) {
    return Error{ErrorCode::out_of_range, std::move(message), {}};
  };
  if (choices.seed > Choices::kMaxSeed) return refuse("the seed is larger than 2000000000");
  if (choices.gap_percent && !(*choices.gap_percent >= 0))
    return refuse("the gap is not a number of at least 0");
  if (choices.threads < 1 || choices.threads > kMaxThreads)
    return refuse("the number of threads is not from 1 to 64");
  return check_settings(choices.settings);
}

}  // namespace quadrille::solve
