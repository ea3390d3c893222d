// SPDX-License-Identifier: MIT
#include "solve/rounds.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace quadrille::discrete {

std::optional<News> Rounds::arrive(std::size_t worker, std::int64_t effort,
                                   const std::function<News()>& tell) {
  Worker& me = workers_[worker];
  const std::int64_t round = round_of(effort);
  if (round == me.round) return std::nullopt;  // Nobody else changes it.
  News news = tell();
  std::unique_lock lock(mutex_);
  me.round = round;
  me.told.push_back({me.round, std::move(news)});
  forget();
  decide();
  changed_.notify_all();
  const auto has_arrived = [&](const Worker& other) {
    return other.has_ended || other.round >= me.round;
  };
  if (!race_)
    changed_.wait(
        lock, [&] { return over_ || std::all_of(workers_.begin(), workers_.end(), has_arrived); });
  return heard_by(worker);
}

/// Rounds end at length / 32, length / 16, ..., length, 2 length, 3 length, ...
std::int64_t Rounds::round_of(std::int64_t effort) const {
  constexpr std::int64_t kDoublings = 5;
  if (effort >= length_) return 1 + kDoublings + effort / length_;
  const auto part = static_cast<std::uint64_t>((effort << kDoublings) / length_);
  return 1 + static_cast<std::int64_t>(std::bit_width(part));
}

News Rounds::heard_by(std::size_t listener) const {
  News heard;
  heard.others_ended = true;
  const std::int64_t round = workers_[listener].round;
  for (std::size_t w = 0; w < workers_.size(); ++w) {
    if (w == listener) continue;
    const Worker& other = workers_[w];
    const News* news = &other.last;
    if (race_) {
      if (!other.has_ended && !other.told.empty()) news = &other.told.back().news;
      if (!other.has_ended) heard.others_ended = false;
    } else {
      const auto told = std::find_if(other.told.begin(), other.told.end(),
                                     [&](const Told& t) { return t.round >= round; });
      if (told != other.told.end()) news = &told->news;
      // Who has come as far as this one may or may not have ended by now.
      if (!other.has_ended || other.round >= round) heard.others_ended = false;
    }
    heard.lower = std::max(heard.lower, news->lower);
    if (news->plan && (!heard.plan || news->cost < heard.cost)) {
      heard.plan = news->plan;
      heard.cost = news->cost;
    }
    if (!heard.draft) heard.draft = news->draft;
  }
  return heard;
}

/// A worker hears what is told in its round or later; with `race` it hears the last of it.
void Rounds::forget() {
  std::int64_t round = INT64_MAX;
  for (const Worker& w : workers_)
    if (!w.has_ended) round = std::min(round, w.round);
  for (Worker& w : workers_)
    while (w.told.size() > 1 && (race_ || w.told.front().round < round)) w.told.pop_front();
}

void Rounds::end(std::size_t worker, bool has_proof, News last) {
  const std::lock_guard lock(mutex_);
  Worker& me = workers_[worker];
  me.has_ended = true;
  me.has_proof = has_proof;
  me.last = std::move(last);
  decide();
  changed_.notify_all();
}

void Rounds::cancel() {
  const std::lock_guard lock(mutex_);
  over_ = true;
  changed_.notify_all();
}

/// A proof wins as soon as nobody can come before it any more.
void Rounds::decide() {
  if (winner_) return;
  const auto place = [&](std::size_t w) { return std::make_pair(workers_[w].round, w); };
  std::optional<std::size_t> best;
  for (std::size_t w = 0; w < workers_.size(); ++w)
    if (workers_[w].has_proof && (!best || place(w) < place(*best))) best = w;
  if (!best) return;
  for (std::size_t w = 0; w < workers_.size() && !race_; ++w)
    if (!workers_[w].has_ended && place(w) < place(*best)) return;
  winner_ = best;
  over_ = true;
}

}  // namespace quadrille::discrete
