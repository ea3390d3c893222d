// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "traffic/bans_around.hpp"
#include "traffic/traffic.hpp"

namespace quadrille::continuous {

/// A table of bans per class, with a slot for each path.
class ReadyTraffic final : public Traffic {
 public:
  explicit ReadyTraffic(Scene& scene);

  [[nodiscard]] Handle put(ClassId c, const std::vector<Step>& steps) override;
  void show(Handle path, bool on) override;
  void take_out(Handle path) override;
  void clear() override;
  [[nodiscard]] BanTable& bans(ClassId c) override { return tables_[c.index()]; }

 private:
  struct Entry {
    std::vector<std::vector<Ban>> bans;  // by class of the others
    std::size_t slot = 0;                // in all tables
    bool is_in = false;
    bool is_shown = false;
  };
  void clear_tables();
  void add_slot(Entry& entry);
  void drop_old_slots();

  Scene& scene_;
  BansAround bans_around_;
  std::vector<BanTable> tables_;  // by class
  std::vector<Entry> entries_;    // by handle
  std::vector<Handle> free_;
  std::size_t num_slots_ = 0;
};

}  // namespace quadrille::continuous
