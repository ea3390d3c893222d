// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "paths/bans.hpp"
#include "traffic/steps.hpp"

namespace quadrille::continuous {

/// The paths of agents on their way, and what they forbid to the others. A path that was put in can
/// be hidden, shown again and taken out.
class Traffic {
 public:
  /// What suits the instance. With few classes the bans around a path are made when it is put in,
  /// for every class: each search finds them ready. With many, most of these would never be looked
  /// at: there the bans of a place are made when a search comes to it, of the paths that come near.
  /// Both give the same bans. `scene` outlives the result.
  [[nodiscard]] static std::unique_ptr<Traffic> make(Scene& scene);
  virtual ~Traffic() = default;
  Traffic(const Traffic&) = delete;
  Traffic& operator=(const Traffic&) = delete;

  /// A path, as long as it is not taken out.
  using Handle = std::uint32_t;
  /// Puts in a path of an agent of class `c`, shown. Throws LimitReached; then it is not in.
  [[nodiscard]] virtual Handle put(ClassId c, const std::vector<Step>& steps) = 0;
  virtual void show(Handle path, bool on) = 0;
  virtual void take_out(Handle path) = 0;
  virtual void clear() = 0;

  /// What keeps an agent of class `c` clear of all shown paths. Valid until the traffic changes or
  /// is asked again. A search in it may throw LimitReached.
  [[nodiscard]] virtual BanTable& bans(ClassId c) = 0;

  /// Elementary steps so far: bans made, paths compared.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 protected:
  Traffic() = default;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::continuous
