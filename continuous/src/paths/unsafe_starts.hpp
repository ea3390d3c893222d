// SPDX-License-Identifier: MIT
#pragma once

#include "paths/timed_path.hpp"
#include "quadrille/geometry/tick_interval.hpp"

namespace quadrille::continuous {

using geometry::TickInterval;

// From contacts to starts of moves. `offsets`: the differences t - s of unsafe starts s of a move e
// and t of a move f. `contact`: the stretch, in ticks since the start of a move, during which its
// agent is in contact with a place. See Contacts.

/// The starts t of f that collide with a start of e at `s`.
[[nodiscard]] constexpr TickInterval starts_against(const TickInterval& offsets, Ticks s) {
  return offsets.shifted(s);
}

/// The starts s of e that collide with a start of f at `t`.
[[nodiscard]] constexpr TickInterval starts_before(const TickInterval& offsets, Ticks t) {
  return offsets.mirrored().shifted(t);
}

/// The starts t of f that collide with every start of e in `starts`, which is not empty: t - s is
/// unsafe for the first s and for the last one, and so for those between.
[[nodiscard]] constexpr TickInterval starts_against_all(const TickInterval& offsets,
                                                        const TickInterval& starts) {
  return {offsets.begin + starts.last(), offsets.end + starts.first()};
}

/// The starts of the move that collide with a stay [arrive, leave] at the place. `leave` may be
/// kForever; then the result has no end either.
[[nodiscard]] constexpr TickInterval starts_meeting(const TickInterval& contact, Ticks arrive,
                                                    Ticks leave) {
  return {arrive - contact.end + 1, leave >= kForever ? kForever : leave - contact.begin};
}

/// The starts of the move that collide with every stay that meets the stretch: there the place is
/// in contact during all of it. May be empty.
[[nodiscard]] constexpr TickInterval starts_meeting_all(const TickInterval& contact,
                                                        const TickInterval& stretch) {
  return {stretch.end - contact.end, stretch.begin - contact.begin + 1};
}

}  // namespace quadrille::continuous
