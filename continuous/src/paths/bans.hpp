// SPDX-License-Identifier: MIT
#pragma once

#include <bitset>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "paths/timed_path.hpp"
#include "paths/unsafe_starts.hpp"

namespace quadrille::continuous {

/// Something that one agent may not do.
///
/// - start: begin to move along an edge at one of the ticks `when`.
/// - stay: be at a vertex at some moment of the stretch `when`. Passing through counts as well;
///   arriving at its end or departing at its begin is allowed.
/// Bans without end end with kForever.
struct Ban {
  enum class Kind : std::uint8_t { start, stay };
  Kind kind = Kind::start;
  std::uint32_t place = 0;  ///< An edge or a vertex.
  TickInterval when;

  [[nodiscard]] static Ban start(EdgeId edge, const TickInterval& when) {
    return {Kind::start, edge.value(), when};
  }
  [[nodiscard]] static Ban stay(VertexId vertex, const TickInterval& when) {
    return {Kind::stay, vertex.value(), when};
  }
  /// To end there and stay for good. To pass or to wait is allowed: no move ends that late.
  [[nodiscard]] static Ban end(VertexId vertex) {
    return {Kind::stay, vertex.value(), {kForever - 1, kForever}};
  }
  [[nodiscard]] bool is_end() const { return *this == end(VertexId(place)); }
  /// The last tick at which it begins or ends, but not for ever.
  [[nodiscard]] Ticks last_change() const {
    if (when.end < kForever) return when.end;
    return is_end() ? Ticks{0} : when.begin;
  }
  friend auto operator<=>(const Ban&, const Ban&) = default;
};

/// What a path does, sorted by place, to look for breaches of bans in logarithmic time.
class PathUses {
 public:
  void assign(const Instance& instance, AgentId agent, const TimedPath& path);
  [[nodiscard]] bool breaks(const Ban& ban) const;
  [[nodiscard]] bool breaks(std::span<const Ban> bans) const;

 private:
  struct Start {
    std::uint32_t edge;
    Ticks tick;
    friend auto operator<=>(const Start&, const Start&) = default;
  };
  struct Stay {
    std::uint32_t vertex;
    Ticks arrive, depart;
    friend auto operator<=>(const Stay&, const Stay&) = default;
  };
  std::vector<Start> starts_;
  std::vector<Stay> stays_;
  // Which edges and vertices occur, by their last bits: most bans are about others.
  static constexpr std::size_t kBits = 1024;
  std::bitset<kBits> edges_, vertices_;
};

/// Who knows the bans of one agent and is asked for them place by place.
class BanSource {
 public:
  virtual ~BanSource() = default;
  /// Appends all ticks, `from` or later, at which the agent may not begin to move along the edge;
  /// perhaps earlier ones.
  virtual void list_starts(EdgeId e, Ticks from, std::vector<TickInterval>& bans) = 0;
  /// Appends all stretches during which the agent may not be at the vertex.
  virtual void list_stays(VertexId v, std::vector<TickInterval>& bans) = 0;
  /// No ban begins or ends after this tick.
  [[nodiscard]] virtual Ticks horizon() const = 0;
};

/// The bans of one agent at work, by place. Each ban belongs to a *slot*, and slots can be switched
/// off and on. Costs nothing in the size of the roadmap but memory for one table.
class BanTable {
 public:
  explicit BanTable(const Roadmap& roadmap);

  /// Leaves nothing but the bans in `standing`, which belong to no slot and hold always.
  void clear(std::span<const Ban> standing = {});
  /// Clears the table. From now on, until it is cleared, it has the bans that `source` names, which
  /// is asked for those of a place when they are first looked for; they are one slot, and none can
  /// be added.
  void ask(BanSource& source);
  /// Adds the bans as the next slot, switched on.
  void add(std::span<const Ban> bans);
  [[nodiscard]] std::size_t num_slots() const noexcept { return enabled_.size(); }
  /// After this, what `safe_*` gave is stale.
  void enable(std::size_t slot, bool on);

  /// A stay that obeys all bans, as does each that is part of it: [from, until], both included. It
  /// may be one tick without length.
  struct SafeStay {
    Ticks from, until;
  };
  /// Index of a place with bans, or kFree. Switched-off slots count.
  static constexpr std::uint32_t kFree = 0xffffffffu;
  /// Of a table that asks, bans before `from` may be missing.
  [[nodiscard]] std::uint32_t starts_of(EdgeId e, Ticks from = 0) {
    if (source_ != nullptr) ask_for(e.index(), from);
    return index_[e.index()];
  }
  [[nodiscard]] std::uint32_t stays_of(VertexId v) {
    if (source_ != nullptr) ask_for(num_edges_ + v.index(), 0);
    return index_[num_edges_ + v.index()];
  }

  /// Forbidden starts, united, increasing. Valid until the table changes.
  [[nodiscard]] const std::vector<TickInterval>& forbidden_starts(std::uint32_t place);
  /// The maximal safe stays, increasing, none of which contains another. None is from before 0; the
  /// last may be until kForever.
  [[nodiscard]] const std::vector<SafeStay>& safe_stays(std::uint32_t place);

  /// From this tick on nothing changes any more: no ban begins or ends later, but for those of
  /// kind Ban::end.
  [[nodiscard]] Ticks horizon() const { return source_ != nullptr ? source_->horizon() : horizon_; }

  /// The slot of bans that stand.
  static constexpr std::uint32_t kStanding = 0xffffffffu;
  struct Entry {
    TickInterval when;
    std::uint32_t slot;
  };
  /// All bans of a place, switched off or not.
  [[nodiscard]] const std::vector<Entry>& entries(std::uint32_t place) const {
    return places_[place].entries;
  }
  [[nodiscard]] bool is_enabled(std::size_t slot) const {
    return slot == kStanding || enabled_[slot] != 0;
  }

 private:
  struct Place {
    std::size_t resource = 0;  // into index_
    std::vector<Entry> entries;
    std::vector<TickInterval> forbidden;  // of an edge, of version `version`
    std::vector<SafeStay> safe;           // of a vertex, likewise
    std::uint64_t version = 0;
    bool is_sorted = false;
  };
  [[nodiscard]] bool refresh(Place& place);
  void put(const Ban& ban, std::uint32_t slot);
  [[nodiscard]] Place& place_of(std::size_t resource);
  void ask_for(std::size_t resource, Ticks from);

  std::size_t num_edges_;
  std::vector<std::uint32_t> index_;  // by edge, then by vertex: into places_, or kFree
  std::vector<Place> places_;
  std::size_t num_used_ = 0;
  std::vector<char> enabled_;
  Ticks horizon_ = 0;  // of the bans that were added
  std::uint64_t version_ = 1;

  BanSource* source_ = nullptr;
  std::vector<std::uint32_t> asked_;  // by resource: in which session it was asked for
  std::vector<Ticks> asked_from_;     // by resource: its bans from then on are here
  std::uint32_t session_ = 0;
  std::vector<TickInterval> answer_;
};

/// The first slot of the table, switched on or not, with a ban that the path breaks. In time
/// proportional to the bans of the places on its way.
[[nodiscard]] std::optional<std::size_t> first_broken(const Instance& instance, AgentId agent,
                                                      const TimedPath& path, BanTable& bans);

}  // namespace quadrille::continuous
