// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// An agent of a session, as long as it is there. No number is given twice.
using MemberId = StrongId<struct MemberTag>;

}  // namespace quadrille

QUADRILLE_API_END
