// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "quadrille/core/effort.hpp"

namespace quadrille::solve {

/// Searches in threads of their own that go through rounds of equal effort together, exchange what
/// they know at the end of each, and agree on whose proof is the answer. What a search hears
/// depends on the efforts of all, but not on how fast their threads run: at the end of its round r
/// it hears what each of the others told at its first arrival in round r - lag or later (in round r
/// of the first, short ones).
///
/// `Message` is what they tell. `message.hear(other)` merges what another one told into it; its
/// field `others_ended` becomes true for whom nobody else is at work.
template <class Message>
class Rounds {
 public:
  /// The first round ends when a worker arrives at all. Then one takes `length`; at first a
  /// thirty-second of it and twice as many again and again, because easy instances are over soon.
  /// With `race` nobody waits, and what is heard is what is known at the time. With a `lag` workers
  /// wait less for each other, and messages are older. Requires length > 0, lag >= 0.
  Rounds(std::size_t num_workers, Effort length, bool race, std::int64_t lag = 0)
      : length_(length), race_(race), lag_(lag), workers_(num_workers) {}

  [[nodiscard]] std::size_t num_workers() const noexcept { return workers_.size(); }

  /// A worker has done `effort` in all. Within a round this returns nullopt at once; at the
  /// end of one it publishes `tell()`, waits for the others and returns what they told, merged.
  [[nodiscard]] std::optional<Message> arrive(std::size_t worker, Effort effort,
                                              const std::function<Message()>& tell) {
    Worker& me = workers_[worker];
    const std::int64_t round = round_of(effort);
    if (round == me.round) return std::nullopt;  // Nobody else changes it.
    Message message = tell();
    std::unique_lock lock(mutex_);
    me.round = round;
    me.told.push_back({me.round, std::move(message)});
    forget();
    decide();
    changed_.notify_all();
    const auto has_arrived = [&](const Worker& other) {
      return other.has_ended || other.round >= heard_from(me.round);
    };
    if (!race_)
      changed_.wait(lock, [&] {
        return over_ || std::all_of(workers_.begin(), workers_.end(), has_arrived);
      });
    return heard_by(worker);
  }
  /// A worker does nothing more. With `has_proof` its answer ends all others.
  void end(std::size_t worker, bool has_proof, Message last) {
    const std::lock_guard lock(mutex_);
    Worker& me = workers_[worker];
    me.has_ended = true;
    me.has_proof = has_proof;
    me.last = std::move(last);
    decide();
    changed_.notify_all();
  }
  /// Ends all searches, without an answer.
  void cancel() {
    const std::lock_guard lock(mutex_);
    over_ = true;
    changed_.notify_all();
  }

  /// Set when nobody's answer is needed any more.
  [[nodiscard]] const std::atomic<bool>& over() const noexcept { return over_; }
  /// Whose answer counts, once all have ended. The proof of the earliest round, among these that
  /// of the first worker.
  [[nodiscard]] std::optional<std::size_t> winner() const noexcept { return winner_; }

 private:
  static constexpr std::int64_t kDoublings = 5;
  struct Told {
    std::int64_t round;
    Message message;
  };
  struct Worker {
    std::int64_t round = 0;
    bool has_ended = false, has_proof = false;
    std::deque<Told> told;  // What somebody may still have to hear.
    Message last;
  };

  /// Rounds end at length / 32, length / 16, ..., length, 2 length, 3 length, ...
  [[nodiscard]] std::int64_t round_of(Effort effort) const {
    if (effort >= length_) return 1 + kDoublings + effort / length_;
    const auto part =
        static_cast<std::uint64_t>((std::int64_t{1} << kDoublings) * effort / length_);
    return 1 + static_cast<std::int64_t>(std::bit_width(part));
  }

  /// The round whose messages are heard at the end of a round.
  [[nodiscard]] std::int64_t heard_from(std::int64_t round) const {
    return std::max(round - lag_, std::min(round, 2 + kDoublings));
  }

  /// A proof wins as soon as nobody can come before it any more.
  void decide() {
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

  /// A worker hears what is told `lag` rounds before its own or later; with `race` it hears the
  /// last of it.
  void forget() {
    std::int64_t round = INT64_MAX;
    for (const Worker& w : workers_)
      if (!w.has_ended) round = std::min(round, w.round);
    for (Worker& w : workers_)
      while (w.told.size() > 1 && (race_ || w.told.front().round < heard_from(round)))
        w.told.pop_front();
  }

  [[nodiscard]] Message heard_by(std::size_t listener) const {
    Message heard;
    heard.others_ended = true;
    const std::int64_t round = heard_from(workers_[listener].round);
    for (std::size_t w = 0; w < workers_.size(); ++w) {
      if (w == listener) continue;
      const Worker& other = workers_[w];
      const Message* message = &other.last;
      if (race_) {
        if (!other.has_ended && !other.told.empty()) message = &other.told.back().message;
        if (!other.has_ended) heard.others_ended = false;
      } else {
        const auto told = std::find_if(other.told.begin(), other.told.end(),
                                       [&](const Told& t) { return t.round >= round; });
        if (told != other.told.end()) message = &told->message;
        // Who has come as far as that may or may not have ended by now.
        if (!other.has_ended || other.round >= round) heard.others_ended = false;
      }
      heard.hear(*message);
    }
    return heard;
  }

  const Effort length_;
  const bool race_;
  const std::int64_t lag_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Worker> workers_;
  std::optional<std::size_t> winner_;
  std::atomic<bool> over_ = false;
};

}  // namespace quadrille::solve
