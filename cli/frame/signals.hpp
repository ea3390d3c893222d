// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace quadrille::cli {

/// From now on the first SIGINT or SIGTERM sets the flag that is returned, and the second one kills
/// the process as if it had never been handled.
[[nodiscard]] const std::atomic<bool>& catch_interrupts();

/// A reader that goes away makes the next write fail instead of killing the process, so that the
/// other outputs are still written.
void ignore_broken_pipes();

}  // namespace quadrille::cli
