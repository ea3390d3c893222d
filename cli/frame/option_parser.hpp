// SPDX-License-Identifier: MIT
#pragma once

// CLI11 is one header, whose objects every file that includes it compiles, used or not: five
// seconds each. Headers name its classes only; files that call them include <CLI/CLI.hpp>.

namespace CLI {
class App;
class Option;
}  // namespace CLI
