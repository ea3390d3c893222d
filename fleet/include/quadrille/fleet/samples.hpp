// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/timed_plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

inline constexpr int kSamplesJsonVersion = 1;

/// The samples of all robots, as TimedPath::samples gives them: robot by robot, each by time.
/// Columns robot, time_s, x_m, y_m, vx_mps, vy_mps, where there are heights also z_m after y_m and
/// vz_mps at the end; a first line names them. Numbers are the shortest that are read as the same
/// double. `file`: for the error, io. Requires a positive rate.
[[nodiscard]] std::optional<Error> write_samples_csv(std::ostream& out, const std::string& file,
                                                     const TimedPlan& plan, Hertz rate);

/// The same as JSON: "rate_hz", and for each of "robots" its "name" and its "samples", a list of
/// [time, x, y, vx, vy], where there are heights [time, x, y, z, vx, vy, vz].
[[nodiscard]] std::optional<Error> write_samples_json(std::ostream& out, const std::string& file,
                                                      const TimedPlan& plan, Hertz rate);

}  // namespace quadrille::fleet

QUADRILLE_API_END
