// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "quadrille/core/ids.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// What searches of the same instance tell each other.
struct News {
  Cost lower = 0;                     ///< Proven.
  std::shared_ptr<const Plan> plan;   ///< The cheapest; null if there is none.
  Cost cost = 0;                      ///< What it costs.
  std::shared_ptr<const Plan> draft;  ///< Paths that may collide; null if there are none.
  bool others_ended = false;          ///< Nobody else is at work.
};

/// Searches in threads of their own that go through rounds of equal effort together, exchange what
/// they know at the end of each, and agree on whose proof is the answer. What a search hears
/// depends on the efforts of all, but not on how fast their threads run: at the end of its round r
/// it hears what each of the others told at its first arrival in round r or later.
class Rounds {
 public:
  /// The first round ends when a worker arrives at all. Then one takes `length` steps; at first a
  /// thirty-second of it and twice as many again and again, because easy instances are over soon.
  /// With `race` nobody waits, and what is heard is what is known at the time. Requires length
  /// >= 1.
  Rounds(std::size_t num_workers, std::int64_t length, bool race)
      : length_(length), race_(race), workers_(num_workers) {}

  /// A worker has done `effort` steps in all. Within a round this returns nullopt at once; at the
  /// end of one it publishes `tell()`, waits for the others and returns what they told, merged.
  [[nodiscard]] std::optional<News> arrive(std::size_t worker, std::int64_t effort,
                                           const std::function<News()>& tell);
  /// A worker does nothing more. With `has_proof` its answer ends all others.
  void end(std::size_t worker, bool has_proof, News last);
  /// Ends all searches, without an answer.
  void cancel();

  /// Set when nobody's answer is needed any more.
  [[nodiscard]] const std::atomic<bool>& over() const noexcept { return over_; }
  /// Whose answer counts, once all have ended. The proof of the earliest round, among these that
  /// of the first worker.
  [[nodiscard]] std::optional<std::size_t> winner() const noexcept { return winner_; }

 private:
  struct Told {
    std::int64_t round;
    News news;
  };
  struct Worker {
    std::int64_t round = 0;
    bool has_ended = false, has_proof = false;
    std::deque<Told> told;  // What somebody may still have to hear.
    News last;
  };

  [[nodiscard]] std::int64_t round_of(std::int64_t effort) const;
  void decide();
  void forget();
  [[nodiscard]] News heard_by(std::size_t listener) const;

  const std::int64_t length_;
  const bool race_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Worker> workers_;
  std::optional<std::size_t> winner_;
  std::atomic<bool> over_ = false;
};

}  // namespace quadrille::discrete
