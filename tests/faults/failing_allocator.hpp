// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace quadrille::support {

/// From now on the n-th allocation of this program and `length - 1` after it throw bad_alloc.
void fail_allocations(std::int64_t n, std::int64_t length);
/// No allocation fails any more. The number of allocations since the last call of either.
std::int64_t stop_failing();

}  // namespace quadrille::support
