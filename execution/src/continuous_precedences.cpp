// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "ordering.hpp"
#include "passages.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/execution/precedences.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "windows.hpp"

namespace quadrille::execution {
namespace {

using continuous::ClassId;
using continuous::Instance;
using continuous::ShapeId;
using geometry::BodyPair;
using geometry::Length;
using geometry::Motion;

/// Moves of the same class of agents along the same way, in the same time.
struct Kind {
  ClassId body;
  ShapeId shape;
  Motion motion;
  Length left = 0, right = 0, bottom = 0, top = 0;  // What the bodies cover is inside.
  std::vector<MoveId> moves;
};

class Finder {
 public:
  Finder(const Instance& instance, const continuous::Plan& plan) : instance_(instance) {
    result_.now = instance.now();
    result_.moves.resize(plan.paths.size());
    for (const AgentId agent : instance.agent_ids()) add_moves(agent, plan.paths[agent]);
  }

  Result<Precedences> run() {
    // From left to right; a kind is held against those before it that reach as far.
    std::sort(kinds_.begin(), kinds_.end(),
              [](const Kind& a, const Kind& b) { return a.left < b.left; });
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      const Kind& kind = kinds_[k];
      std::erase_if(open, [&](std::size_t other) { return kinds_[other].right <= kind.left; });
      open.push_back(k);
      for (const std::size_t other : open)
        if (kinds_[other].bottom < kind.top && kind.bottom < kinds_[other].top)
          compare(kinds_[other], kind);
    }
    if (contradiction_) return *contradiction_;
    sort_precedences(result_.list);
    drop_implied();
    if (auto error = why_passages_block(result_)) return *error;
    return std::move(result_);
  }

 private:
  void add_moves(AgentId agent, const continuous::Path& path) {
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const continuous::Stop &here = path[k], &there = path[k + 1];
      const MoveId id{agent, static_cast<std::uint32_t>(k)};
      const bool goes_on = k + 2 < path.size() && !instance_.roadmap().may_wait(there.vertex);
      result_.moves[agent].push_back(
          {here.vertex, there.vertex, here.depart, there.arrive, goes_on});
      kind_of(instance_.class_of(agent), here.vertex, there.vertex, there.arrive - here.depart)
          .moves.push_back(id);
    }
  }

  Kind& kind_of(ClassId body, VertexId from, VertexId to, Ticks duration) {
    const auto [known, is_new] =
        index_.try_emplace(std::tuple(body, from, to, duration), kinds_.size());
    if (!is_new) return kinds_[known->second];
    const geometry::Point a = instance_.roadmap().position(from);
    const geometry::Point b = instance_.roadmap().position(to);
    const Length reach = instance_.reach(body);
    const ShapeId shape = instance_.roadmap().shape(from, to);
    Kind kind{body, shape, instance_.roadmap().motion(from, to, duration), 0, 0, 0, 0, {}};
    kind.left = std::min(a.x, b.x) - reach;
    kind.right = std::max(a.x, b.x) + reach;
    kind.bottom = std::min(a.y, b.y) - reach;
    kind.top = std::max(a.y, b.y) + reach;
    return kinds_.emplace_back(std::move(kind));
  }

  const BodyPair& bodies(const Kind& a, const Kind& b) {
    const auto key = std::tuple(a.body, a.shape, b.body, b.shape);
    const auto known = pairs_.find(key);
    if (known != pairs_.end()) return known->second;
    return pairs_
        .emplace(key, BodyPair(instance_.body(a.body, a.shape), instance_.body(b.body, b.shape)))
        .first->second;
  }

  /// A body with shapes may be larger during a move than before and after it: moves that have but a
  /// moment in common are apart.
  std::optional<UnsafeWindow> window(const Kind& a, const Kind& b) {
    auto found = unsafe_window(bodies(a, b), a.motion, b.motion);
    if (!found || !instance_.has_shapes()) return found;
    found->below = std::max(found->below, -b.motion.duration);
    found->above = std::min(found->above, a.motion.duration);
    return found;
  }

  void compare(const Kind& a, const Kind& b) {
    const bool same = &a == &b;
    if (same && a.moves.size() < 2) return;
    const auto unsafe = window(a, b);
    if (!unsafe) return;
    for (std::size_t m = 0; m < a.moves.size(); ++m)
      for (std::size_t n = same ? m + 1 : 0; n < b.moves.size(); ++n)
        if (a.moves[m].agent != b.moves[n].agent) order(a.moves[m], b.moves[n], *unsafe);
  }

  void order(const MoveId& a, const MoveId& b, const UnsafeWindow& window) {
    const Ticks offset = result_.at(b).begin - result_.at(a).begin;
    if (offset >= window.above)
      result_.list.push_back({a, b, offset - window.above});
    else if (offset <= window.below)
      result_.list.push_back({b, a, window.below - offset});
    else
      contradiction_ = Error{ErrorCode::internal, "a plan without violations has a collision", {}};
  }

  /// Of two moves of one agent that lead the same move, the later one holds the follower back for
  /// longer; if it does so as strictly, the earlier one says nothing.
  void drop_implied() {
    std::vector<Precedence>& list = result_.list;
    const auto is_implied = [&](std::size_t k) {
      for (std::size_t next = k + 1;
           next < list.size() && list[next].follower == list[k].follower &&
           list[next].leader.agent == list[k].leader.agent;
           ++next)
        if (list[next].slack <= list[k].slack) return true;
      return false;
    };
    std::vector<Precedence> kept;
    for (std::size_t k = 0; k < list.size(); ++k)
      if (!is_implied(k)) kept.push_back(list[k]);
    list = std::move(kept);
  }

  const Instance& instance_;
  Precedences result_;
  std::vector<Kind> kinds_;
  std::map<std::tuple<ClassId, VertexId, VertexId, Ticks>, std::size_t> index_;
  std::map<std::tuple<ClassId, ShapeId, ClassId, ShapeId>, BodyPair> pairs_;
  std::optional<Error> contradiction_;
};

}  // namespace

Result<Precedences> precedences(const Instance& instance, const continuous::Plan& plan) {
  if (!instance.obstacles().empty())
    return Error{ErrorCode::invalid_instance,
                 "moving obstacles wait for nobody: no order of moves keeps clear of them",
                 {}};
  if (!instance.parked_pairs().empty())
    return Error{ErrorCode::invalid_instance,
                 "agents overlap at their starts: no order of moves keeps them apart there",
                 {}};
  const auto report = continuous::verify(instance, plan);
  if (!report.valid()) return Error{ErrorCode::invalid_plan, report.violations.front().message, {}};
  return Finder(instance, plan).run();
}

}  // namespace quadrille::execution
