// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "traffic/square_grid.hpp"
#include "traffic/traffic.hpp"

namespace quadrille::continuous {

/// The steps of all paths by the squares of a grid that their bodies may touch. Bans of a place are
/// made of the steps near it when a search comes there.
class SpatialTraffic final : public Traffic, private BanSource {
 public:
  explicit SpatialTraffic(Scene& scene);

  [[nodiscard]] Handle put(ClassId c, const std::vector<Step>& steps) override;
  void show(Handle path, bool on) override;
  void take_out(Handle path) override;
  void clear() override;
  [[nodiscard]] BanTable& bans(ClassId c) override;

 private:
  /// A step of a path, and where its body may be.
  struct Passage {
    Step step;
    Extent box;
    Handle path = 0;
    std::uint32_t seen = 0;  // in which query
  };
  struct Entry {
    ClassId c;
    std::vector<std::uint32_t> passages;
    bool is_shown = false;
  };

  /// Those of moving obstacles at the place of `least`, which is before all of them.
  void list_standing(const Ban& least, std::vector<TickInterval>& bans) const;
  void list_starts(EdgeId e, Ticks from, std::vector<TickInterval>& bans) override;
  void list_stays(VertexId v, std::vector<TickInterval>& bans) override;
  [[nodiscard]] Ticks horizon() const override;

  /// All passages of shown paths whose boxes meet this one.
  template <class Visit>
  void for_each_near(const Extent& box, const Visit& visit);

  Scene& scene_;
  BanTable table_;
  ClassId asking_;
  std::vector<Entry> entries_;  // by handle
  std::vector<Handle> free_;
  std::vector<Passage> passages_;
  std::vector<std::uint32_t> free_passages_;
  std::uint32_t query_ = 0;

  SquareGrid grid_;
  std::vector<std::vector<std::uint32_t>> squares_;
};

}  // namespace quadrille::continuous
