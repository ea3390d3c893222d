// SPDX-License-Identifier: MIT
#pragma once

namespace quadrille::cli {

/// The whole program: what `main` does, and the exit code of the process. Once per process, since
/// it takes over standard streams and signals.
[[nodiscard]] int run_program(int argc, char** argv);

}  // namespace quadrille::cli
