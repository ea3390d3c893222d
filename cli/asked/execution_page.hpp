// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "asked/execution_case.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {

/// Where the agents of this roadmap are shown, of whose ticks the case has `page_ticks` in one.
/// Agents and vertices of both have the same numbers.
void add_page(const std::shared_ptr<const input::RoadmapInput>& input, std::int64_t page_ticks,
              ExecutionCase& made);

}  // namespace quadrille::cli
