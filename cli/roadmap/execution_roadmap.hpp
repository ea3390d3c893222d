// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "asked/execution_case.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille::cli {

/// What is wrong with the combination of options for a roadmap; empty if nothing is.
[[nodiscard]] std::string check_execution_roadmap(const ExecutionArguments& arguments);
/// Requires options that pass the check.
[[nodiscard]] Result<ExecutionCase> load_execution_roadmap(const ExecutionArguments& arguments);

}  // namespace quadrille::cli
