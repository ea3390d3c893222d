// SPDX-License-Identifier: MIT
#pragma once

#include "timed/pair_side.hpp"

namespace quadrille_check {

/// Whether the two have no plan, as far as the contacts say; false, too, where that takes too long.
[[nodiscard]] bool have_no_plan(const Road& road, const TimedContacts& contacts, TimedPaths& paths,
                                const TimedParty& first, const TimedParty& second);

}  // namespace quadrille_check
