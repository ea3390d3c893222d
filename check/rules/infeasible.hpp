// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "read/instance.hpp"

namespace quadrille_check {

/// Whether the values of a record z name something that no move of the agents changes, and that
/// differs between starts and goals: docs/certificates.md, "Infeasible". Linear in the instance.
/// Throws Rejected if the record is malformed.
[[nodiscard]] bool is_infeasible(const Instance& instance, std::span<const Int> values);

}  // namespace quadrille_check
