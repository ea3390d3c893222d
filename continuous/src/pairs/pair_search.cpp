// SPDX-License-Identifier: MIT
#include "pairs/pair_search.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {
namespace {

std::uint64_t key(std::uint32_t x, std::uint32_t y) {
  return static_cast<std::uint64_t>(x) << 32 | y;
}

}  // namespace

void PairSearch::Reached::clear() {
  slots_.assign(1024, {0, {}});
  size_ = 0;
}

std::size_t PairSearch::Reached::find(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15u) >> 20) & mask;
  while (slots_[at].key != 0 && slots_[at].key != key + 1) at = (at + 1) & mask;
  return at;
}

const PairSearch::Starts& PairSearch::Reached::at(std::uint64_t key) const {
  return slots_[find(key)].starts;
}

bool PairSearch::Reached::widen(std::uint64_t key, const Starts& starts) {
  if (2 * (size_ + 1) > slots_.size()) grow();
  Slot& slot = slots_[find(key)];
  if (slot.key == 0) {
    slot = {key + 1, starts};
    ++size_;
    return true;
  }
  if (slot.starts.x <= starts.x && slot.starts.y <= starts.y) return false;
  slot.starts = {std::min(slot.starts.x, starts.x), std::min(slot.starts.y, starts.y)};
  return true;
}

void PairSearch::Reached::grow() {
  std::vector<Slot> old(4 * slots_.size(), {0, {}});
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.key != 0) slots_[find(slot.key - 1)] = slot;
}

PairSearch::PairSearch(Scene& scene)
    : scene_(scene),
      bans_{BanTable(scene.instance().roadmap()), BanTable(scene.instance().roadmap())} {}

Box PairSearch::box(VertexId v) const {
  const Point& p = scene_.instance().roadmap().position(v);
  return {p.x, p.x, p.y, p.y};
}

Contacts::Window PairSearch::window(ClassId a, EdgeId e, ClassId b, VertexId v, Length reach) {
  if (are_far(boxes_[e.index()], box(v), reach)) return std::nullopt;
  return scene_.contacts().window(a, e, b, v);
}

// s is the start of `next`, t that of b's move; t <= s, because b's move is begun first. A stay
// that matters is followed by a move that matters: so until s, b's agent stays at the end of its
// move, if that matters, and x's agent before `next`. Each test below says what it takes that not
// all of what the elements stand for collides.
PairSearch::Steps PairSearch::steps(const Side& x, const Element& a, Ticks start_a,
                                    const Element& next, Ticks first_s, Side& y, const Element& b,
                                    Ticks first_t) {
  const Instance& instance = scene_.instance();
  const Length reach = instance.reach(x.c) + instance.reach(y.c);
  const auto raise_for_start = [&](Ticks tick) {
    return std::max(raise_for_end(next, tick), raise_to_wait(y, b, first_t, tick));
  };
  Ticks both = raise_for_start(first_s);
  Steps result{{kForever, 0, 0}, {0, first_s, first_t}};
  if (b.is_move) {
    if (!are_far(boxes_[next.edge.index()], boxes_[b.edge.index()], reach)) {
      const auto offsets = scene_.contacts().offsets(x.c, next.edge, y.c, b.edge);
      if (offsets && offsets->first() <= 0) {
        // t - s is before the first unsafe offset or after the last one.
        const Ticks late_s = std::max(first_s, starts_before(*offsets, first_t).end);
        const Ticks late_t = std::max(first_t, starts_against(*offsets, first_s).end);
        result.late = {raise_for_start(late_s), late_s, first_t};
        result.early = {offsets->last() >= 0 ? kForever : raise_for_end(b, late_t), first_s,
                        late_t};
      }
    }
    // x's stay before `next` and b's move: x comes late, or leaves early.
    if (a.stay_matters)
      if (const auto w = window(y.c, b.edge, x.c, a.to, reach))
        both = std::max(both, std::min(raise_for_end(a, first_t + w->end - a.duration),
                                       raise_for_end(b, first_s - w->begin)));
  }
  if (b.stay_matters) {
    // `next` sets out where b stands in its way: b comes late.
    if (const auto w = window(x.c, next.edge, y.c, b.to, reach); w && w->begin < 0)
      both = std::max(both, raise_for_end(b, first_s + w->end - b.duration));
    both = std::max(both, raise_to_pass(x, a, start_a, y, b));
  }
  result.late.raise = std::max(result.late.raise, both);
  result.early.raise = std::max(result.early.raise, both);
  return result;
}

Ticks PairSearch::raise_to_pass(const Side& x, const Element& a, Ticks start_a, const Side& y,
                                const Element& b) {
  if (!a.is_move || !b.stay_matters) return Ticks{0};
  const Instance& instance = scene_.instance();
  const auto w = window(x.c, a.edge, y.c, b.to, instance.reach(x.c) + instance.reach(y.c));
  if (!w || w->begin >= a.duration) return Ticks{0};
  return raise_for_end(b, start_a + w->end - b.duration);
}

bool PairSearch::costs_more(const Pending& a, const Pending& b) {
  return a.raise != b.raise ? a.raise > b.raise : a.pair > b.pair;
}

bool PairSearch::is_later(const Open& a, const Open& b) {
  return a.time != b.time ? a.time > b.time : a.pair > b.pair;
}

void PairSearch::reach(std::uint64_t pair, const Starts& starts) {
  if (!reached_.widen(pair, starts)) return;
  open_.push_back({std::max(starts.x, starts.y), pair});
  std::push_heap(open_.begin(), open_.end(), is_later);
}

void PairSearch::advance(Side& x, std::uint32_t at_x, Ticks start_x, Side& y, std::uint32_t at_y,
                         Ticks start_y, bool is_first) {
  if (at_x == kDone) return;
  const Element &a = x.elements[at_x], &b = y.elements[at_y];
  const auto visit = [&](std::uint32_t k, Ticks raise, Ticks start, Ticks other_start) {
    if (raise > max_raise_) return;
    const std::uint64_t pair = is_first ? key(k, at_y) : key(at_y, k);
    const Starts starts = is_first ? Starts{start, other_start} : Starts{other_start, start};
    if (k == kDone && at_y == kDone) max_raise_ = raise;  // more need not be looked at
    if (raise <= raise_) {
      reach(pair, starts);
    } else {
      pending_.push_back({raise, pair, starts});
      std::push_heap(pending_.begin(), pending_.end(), costs_more);
    }
  };
  const Next& next = next_of(x, a.to);
  if (Ticks raise = raise_for_done(x, a, start_x, next); raise < kForever) {
    if (at_y != kDone) raise = std::max(raise, raise_to_pass(x, a, start_x, y, b));
    visit(kDone, raise, std::max(start_x + a.duration, start_y), start_y);
  }
  for (const Way& way : next.ways) {
    const Ticks arrive = start_x + a.duration + way.ticks;
    for (auto k = x.first_element[way.vertex.index()]; k < x.end_element[way.vertex.index()]; ++k) {
      const Element& to = x.elements[k];
      ++effort_;
      if (!to.matters || to.last < arrive || (way.ticks == 0 && breaks_ban(x, a, to))) continue;
      const Ticks first = std::max({to.first, arrive, start_y});
      if (at_y == kDone) {
        visit(k, raise_for_end(to, first), first, start_y);
        continue;
      }
      const auto [late, early] = steps(x, a, start_x, to, first, y, b, start_y);
      visit(k, late.raise, late.start, late.other_start);
      visit(k, early.raise, early.start, early.other_start);
    }
  }
}

bool PairSearch::next_raise() {
  while (open_.empty() && !pending_.empty()) {
    std::pop_heap(pending_.begin(), pending_.end(), costs_more);
    const Pending next = pending_.back();
    pending_.pop_back();
    raise_ = next.raise;
    reach(next.pair, next.starts);
  }
  return !open_.empty();
}

bool PairSearch::prepare(const Party& i, const Party& j, Ticks max_raise) {
  const Prepared wanted{i, j, max_raise};
  if (prepared_ == wanted) return true;
  prepared_.reset();
  if (boxes_.empty())
    for (const Edge& edge : scene_.instance().roadmap().edges()) {
      const Box a = box(edge.from), b = box(edge.to);
      boxes_.push_back({std::min(a.left, b.left), std::max(a.right, b.right),
                        std::min(a.bottom, b.bottom), std::max(a.top, b.top)});
    }
  Side &first = sides_[0], &second = sides_[1];
  if (!collect_edges(i, max_raise, j, 0, first) || !collect_edges(j, 0, i, max_raise, second))
    return false;
  effort_ += static_cast<std::int64_t>(first.edges.size() + second.edges.size());
  if (!find_contacts(first, second) || !find_contacts(second, first)) return false;
  prepared_ = wanted;
  return true;
}

Ticks PairSearch::refuted_raise(const Party& i, const Party& j, Ticks max_raise,
                                std::int64_t max_steps) {
  Side &first = sides_[0], &second = sides_[1];
  first.bans = &bans_[0];
  second.bans = &bans_[1];
  if (!prepare(i, j, max_raise)) return 0;
  make_elements(first);
  make_elements(second);
  reached_.clear();
  pending_.clear();
  open_.clear();
  raise_ = 0;
  max_raise_ = max_raise;
  reach(key(kStart, kStart), {});
  const std::int64_t last = effort_ + max_steps;
  for (std::size_t count = 0; next_raise(); ++count) {
    std::pop_heap(open_.begin(), open_.end(), is_later);
    const std::uint64_t pair = open_.back().pair;
    open_.pop_back();
    const auto x = static_cast<std::uint32_t>(pair >> 32), y = static_cast<std::uint32_t>(pair);
    if ((x == kDone && y == kDone) || effort_ > last) return raise_;
    if (count % 8192 == 8191 && scene_.limits().exhausted_now()) return raise_;
    const Starts starts = reached_.at(pair);
    advance(first, x, starts.x, second, y, starts.y, true);
    advance(second, y, starts.y, first, x, starts.x, false);
  }
  return max_raise + 1;
}

}  // namespace quadrille::continuous
