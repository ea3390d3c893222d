// SPDX-License-Identifier: MIT
#include "traffic/ready_traffic.hpp"

#include <utility>

namespace quadrille::continuous {
namespace {

/// Bans of paths that were taken out stay in the tables for a while.
constexpr std::size_t kMaxSlotsPerPath = 2, kFewSlots = 16;

}  // namespace

ReadyTraffic::ReadyTraffic(Scene& scene) : scene_(scene), bans_around_(scene) {
  while (tables_.size() < scene.instance().num_classes())
    tables_.emplace_back(scene.instance().roadmap());
  clear_tables();
}

void ReadyTraffic::clear_tables() {
  for (std::size_t a = 0; a < tables_.size(); ++a)
    tables_[a].clear(scene_.standing_bans(ClassId(a)));
  num_slots_ = 0;
}

Traffic::Handle ReadyTraffic::put(ClassId c, const std::vector<Step>& steps) {
  Entry entry;
  for (std::size_t a = 0; a < tables_.size(); ++a) {
    bans_around_.add(ClassId(a), c, steps, entry.bans.emplace_back());
    effort_ += static_cast<std::int64_t>(entry.bans.back().size());
  }
  if (free_.empty()) {
    free_.push_back(static_cast<Handle>(entries_.size()));
    entries_.emplace_back();
  }
  const Handle path = free_.back();
  free_.pop_back();
  entry.is_in = entry.is_shown = true;
  add_slot(entry);
  entries_[path] = std::move(entry);
  if (num_slots_ > kFewSlots + kMaxSlotsPerPath * (entries_.size() - free_.size()))
    drop_old_slots();
  return path;
}

void ReadyTraffic::add_slot(Entry& entry) {
  for (std::size_t a = 0; a < tables_.size(); ++a) {
    tables_[a].add(entry.bans[a]);
    effort_ += static_cast<std::int64_t>(entry.bans[a].size());
  }
  entry.slot = num_slots_++;
}

void ReadyTraffic::drop_old_slots() {
  clear_tables();
  for (Entry& entry : entries_) {
    if (!entry.is_in) continue;
    add_slot(entry);
    for (BanTable& table : tables_) table.enable(entry.slot, entry.is_shown);
  }
}

void ReadyTraffic::show(Handle path, bool on) {
  entries_[path].is_shown = on;
  for (BanTable& table : tables_) table.enable(entries_[path].slot, on);
}

void ReadyTraffic::take_out(Handle path) {
  show(path, false);
  entries_[path] = {};
  free_.push_back(path);
}

void ReadyTraffic::clear() {
  clear_tables();
  entries_.clear();
  free_.clear();
}

}  // namespace quadrille::continuous
