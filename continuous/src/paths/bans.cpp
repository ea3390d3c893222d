// SPDX-License-Identifier: MIT
#include "paths/bans.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

void PathUses::assign(const Instance& instance, AgentId agent, const TimedPath& path) {
  starts_.clear();
  stays_.clear();
  const ClassId c = instance.class_of(agent);
  VertexId at = instance.agent(agent).start;
  Ticks since = 0;
  for (const Move& move : path.moves) {
    stays_.push_back({at.value(), since, move.start});
    starts_.push_back({move.edge.value(), move.start});
    at = instance.roadmap().edge(move.edge).to;
    since = move.start + instance.duration(c, move.edge);
  }
  stays_.push_back({at.value(), since, instance.agent(agent).leaves ? since : kForever});
  edges_.reset();
  vertices_.reset();
  for (const Start& start : starts_) edges_.set(start.edge % kBits);
  for (const Stay& stay : stays_) vertices_.set(stay.vertex % kBits);
  std::sort(starts_.begin(), starts_.end());
  std::sort(stays_.begin(), stays_.end());
}

bool PathUses::breaks(const Ban& ban) const {
  if (!(ban.kind == Ban::Kind::start ? edges_ : vertices_)[ban.place % kBits]) return false;
  if (ban.kind == Ban::Kind::start) {
    const auto at =
        std::lower_bound(starts_.begin(), starts_.end(), Start{ban.place, ban.when.begin});
    return at != starts_.end() && at->edge == ban.place && at->tick < ban.when.end;
  }
  auto at = std::lower_bound(stays_.begin(), stays_.end(), ban.place,
                             [](const Stay& stay, std::uint32_t v) { return stay.vertex < v; });
  for (; at != stays_.end() && at->vertex == ban.place; ++at)
    if (ban.when.meets(at->arrive, at->depart)) return true;
  return false;
}

bool PathUses::breaks(std::span<const Ban> bans) const {
  return std::any_of(bans.begin(), bans.end(), [&](const Ban& ban) { return breaks(ban); });
}

BanTable::BanTable(const Roadmap& roadmap)
    : num_edges_(roadmap.num_edges()),
      index_(roadmap.num_edges() + roadmap.num_vertices(), kFree) {}

void BanTable::clear(std::span<const Ban> standing) {
  for (std::size_t p = 0; p < num_used_; ++p) {
    index_[places_[p].resource] = kFree;
    places_[p].entries.clear();
    places_[p].version = 0;
  }
  num_used_ = 0;
  enabled_.clear();
  horizon_ = 0;
  ++version_;
  source_ = nullptr;
  for (const Ban& ban : standing) put(ban, kStanding);
}

void BanTable::ask(BanSource& source) {
  clear();
  enabled_.push_back(1);
  source_ = &source;
  asked_.resize(index_.size(), 0);
  asked_from_.resize(index_.size());
  if (++session_ == 0) {  // all numbers have been used
    std::fill(asked_.begin(), asked_.end(), 0);
    session_ = 1;
  }
}

void BanTable::ask_for(std::size_t resource, Ticks from) {
  const bool is_known = asked_[resource] == session_;
  if (is_known && asked_from_[resource] <= from) return;
  asked_[resource] = session_;
  asked_from_[resource] = from;
  answer_.clear();
  if (resource < num_edges_)
    source_->list_starts(EdgeId(resource), from, answer_);
  else
    source_->list_stays(VertexId(resource - num_edges_), answer_);
  if (answer_.empty()) return;
  Place& place = place_of(resource);
  if (is_known) {  // from later on; what `forbidden_starts` gave is stale
    place.entries.clear();
    place.version = 0;
  }
  for (const TickInterval& when : answer_) place.entries.push_back({when, 0});
}

BanTable::Place& BanTable::place_of(std::size_t resource) {
  if (index_[resource] == kFree) {
    index_[resource] = static_cast<std::uint32_t>(num_used_);
    if (places_.size() == num_used_) places_.emplace_back();
    places_[num_used_++].resource = resource;
  }
  Place& place = places_[index_[resource]];
  place.is_sorted = false;
  return place;
}

void BanTable::add(std::span<const Ban> bans) {
  QUADRILLE_REQUIRE(source_ == nullptr, "bans are added to a table that asks for them");
  const auto slot = static_cast<std::uint32_t>(enabled_.size());
  enabled_.push_back(1);
  ++version_;
  for (const Ban& ban : bans) put(ban, slot);
}

void BanTable::put(const Ban& ban, std::uint32_t slot) {
  const std::size_t resource = ban.kind == Ban::Kind::start ? ban.place : num_edges_ + ban.place;
  place_of(resource).entries.push_back({ban.when, slot});
  horizon_ = std::max(horizon_, ban.last_change());
}

void BanTable::enable(std::size_t slot, bool on) {
  if ((enabled_[slot] != 0) == on) return;
  enabled_[slot] = on ? 1 : 0;
  ++version_;
}

bool BanTable::refresh(Place& place) {
  if (place.version == version_) return false;
  place.version = version_;
  place.forbidden.clear();
  place.safe.clear();
  if (!place.is_sorted) {
    std::sort(place.entries.begin(), place.entries.end(), [](const Entry& a, const Entry& b) {
      return a.when.begin != b.when.begin ? a.when.begin < b.when.begin : a.slot < b.slot;
    });
    place.is_sorted = true;
  }
  return true;
}

const std::vector<TickInterval>& BanTable::forbidden_starts(std::uint32_t index) {
  Place& place = places_[index];
  if (!refresh(place)) return place.forbidden;
  for (const auto& [when, slot] : place.entries) {
    if (!is_enabled(slot)) continue;
    if (!place.forbidden.empty() && when.begin <= place.forbidden.back().end)
      place.forbidden.back().end = std::max(place.forbidden.back().end, when.end);
    else
      place.forbidden.push_back(when);
  }
  return place.forbidden;
}

// A stay obeys a ban if it ends by the begin of its stretch or begins at its end or later. So
// between two bans whose stretches do not overlap there is a safe stay, even if it is one tick
// without length.
const std::vector<BanTable::SafeStay>& BanTable::safe_stays(std::uint32_t index) {
  Place& place = places_[index];
  if (!refresh(place)) return place.safe;
  Ticks free_from = 0;
  for (const auto& [when, slot] : place.entries) {
    if (!is_enabled(slot) || when.end <= free_from) continue;
    if (when.begin >= free_from) place.safe.push_back({free_from, when.begin});
    free_from = when.end;
  }
  if (free_from < kForever) place.safe.push_back({free_from, kForever});
  return place.safe;
}

std::optional<std::size_t> first_broken(const Instance& instance, AgentId agent,
                                        const TimedPath& path, BanTable& bans) {
  std::size_t first = BanTable::kStanding;
  const auto look = [&](std::uint32_t place, const auto& is_broken) {
    if (place == BanTable::kFree) return;
    for (const BanTable::Entry& entry : bans.entries(place))
      if (entry.slot < first && is_broken(entry.when)) first = entry.slot;
  };
  const auto look_at_stay = [&](VertexId v, Ticks arrive, Ticks depart) {
    look(bans.stays_of(v), [&](const TickInterval& ban) { return ban.meets(arrive, depart); });
  };
  const ClassId c = instance.class_of(agent);
  VertexId at = instance.agent(agent).start;
  Ticks since = 0;
  for (const Move& move : path.moves) {
    look_at_stay(at, since, move.start);
    look(bans.starts_of(move.edge),
         [&](const TickInterval& ban) { return ban.contains(move.start); });
    at = instance.roadmap().edge(move.edge).to;
    since = move.start + instance.duration(c, move.edge);
  }
  look_at_stay(at, since, instance.agent(agent).leaves ? since : kForever);
  if (first == BanTable::kStanding) return std::nullopt;
  return first;
}

}  // namespace quadrille::continuous
