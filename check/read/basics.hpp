// SPDX-License-Identifier: MIT
// What all parts of quadrille-check share. This program uses nothing of the solver: it shares no
// header and no line with it.
#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace quadrille_check {

using Int = std::int64_t;
using Ints = std::vector<Int>;

/// The certificate does not prove what it claims; says why.
struct Rejected : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The instance, or the command line, is wrong.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void require(bool holds, const char* otherwise) {
  if (!holds) throw Rejected(otherwise);
}

/// Times and costs are less than this, so that sums of two fit into 32 bits.
inline constexpr Int kEndOfTime = Int{1} << 28;
/// A distance that no place has: there is no way.
inline constexpr int kFar = 1 << 29;
/// Of a range of time without end.
inline constexpr int kForever = std::numeric_limits<int>::max();

}  // namespace quadrille_check
