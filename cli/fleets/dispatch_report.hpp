// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace quadrille::cli {

/// What became of a fleet that worked. Times are in the unit of the input.
struct DispatchReport {
  std::size_t robots = 0, served = 0, contacts = 0, waiting = 0, origins = 0, too_late = 0;
  std::uint64_t seed = 0;
  bool is_on_grid = false;  ///< Where robots have no clocks of their own, and plans a window.
  double time = 0;
  std::vector<double> service_times;
  // Of each call: by how many per cent it is proved to be too dear at most, 0 if there was nothing
  // to do, and what it took.
  std::vector<double> call_gaps, call_seconds;
  std::vector<double> gaps;  ///< Of those in which there was something to do.

  [[nodiscard]] std::size_t calls() const { return call_seconds.size(); }
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string json() const;
};

}  // namespace quadrille::cli
