// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille::dispatch {

/// What the instance asks for and a live fleet would not heed, if there is any such thing.
[[nodiscard]] std::optional<Error> refuse_unheeded(const continuous::Instance& instance);

}  // namespace quadrille::dispatch
