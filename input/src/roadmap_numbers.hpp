// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::input {

/// What all agents have in common.
struct Numbers {
  double resolution;
  continuous::Length radius;
  continuous::Speed speed;
};
/// As the options say. Errors (out_of_range): those of continuous::quantise_radius and
/// quantise_speed, with the option.
[[nodiscard]] Result<Numbers> quantise(const RoadmapOptions& options);

}  // namespace quadrille::input
