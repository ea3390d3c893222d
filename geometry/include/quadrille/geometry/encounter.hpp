// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/geometry/body.hpp"
#include "quadrille/geometry/point.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::geometry {

/// What FCL says of two bodies that move.
enum class Encounter {
  clear,      ///< Apart at every moment.
  touch,      ///< Neither: as far as the tolerance lets it see, they touch.
  collision,  ///< They overlap at some moment.
};
[[nodiscard]] std::string_view to_string(Encounter encounter) noexcept;  ///< "clear" | ...

/// Straight and at constant speed from `from` at tick `begin` to `to` at tick `end`, both included;
/// a stay if the places are the same, a moment if the ticks are. Of any length. With `whole` > 0 it
/// is a part of that way, which takes so many ticks, of which `behind` are over at `begin`; then it
/// goes on until `end`, or stands there.
struct Leg {
  Point from, to;
  Ticks begin = 0, end = 0;
  Ticks behind = 0, whole = 0;
  bool stands = false;
};

/// A second opinion on two bodies that move, for checks: conservative advancement on FCL's
/// distances, in floating point and with a tolerance. It looks at no samples, and shares no code
/// with what BodyPair decides.
///
/// Each body is also looked at a little smaller: shrunk about its centre, of a polygon the mean of
/// its corners, by kRelativeTolerance, or by more where rounding of large coordinates asks for it.
/// - `clear`: at each moment some straight line (some plane) separates the bodies by more than
///   rounding can amount to. FCL's nearest points propose lines; how long one of them holds follows
///   from corners, radii and the constant speed at which the bodies approach it.
/// - `collision`: at some moment FCL finds the shrunk bodies overlapping, or nearer to each other
///   than half of what they have been shrunk by.
/// - `touch`: everything else, also where FCL fails.
/// So what stays farther apart than tolerance() is `clear` and what is deeper in each other than
/// that is a `collision`, unless FCL fails; bodies that never meet are never a `collision` as long
/// as FCL's distances are right, and bodies that do meet are never `clear`, whatever FCL says.
///
/// After B. Mirtich's conservative advancement (1996); because bodies do not turn, they approach a
/// line at constant speed, and one line proves a whole stretch of time. Immutable; may be used from
/// several threads at once.
class EncounterCheck {
 public:
  static constexpr double kRelativeTolerance = 1e-6;

  /// `extent`: no coordinate of the legs is larger; in [0, kMaxLength]. Requires radii in [1,
  /// kMaxLength]. Linear in the number of corners.
  EncounterCheck(const Body& a, const Body& b, Length extent);
  ~EncounterCheck();
  EncounterCheck(EncounterCheck&&) noexcept;
  EncounterCheck& operator=(EncounterCheck&&) noexcept;

  /// In length units.
  [[nodiscard]] double tolerance() const noexcept;

  /// During the ticks that both legs share; `clear` if there are none. Requires coordinates within
  /// the extent, all of one height if one of the bodies is a polygon, and begin <= end, all ticks
  /// within 2^61. A few queries of FCL; none where the discs
  /// around the bodies do not meet.
  [[nodiscard]] Encounter look(const Leg& a, const Leg& b) const;

 private:
  class Pair;
  std::unique_ptr<const Pair> pair_;
};

}  // namespace quadrille::geometry

QUADRILLE_API_END
