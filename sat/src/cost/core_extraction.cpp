// SPDX-License-Identifier: MIT
#include "cost/core_extraction.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "cost/plan_query.hpp"

namespace quadrille::sat {

CoreExtraction::CoreExtraction(const CostSearchContext& context, const CoreGuidedOptions& options,
                               Statistics& statistics)
    : context_(context),
      options_(options),
      statistics_(statistics),
      minimiser_(context),
      order_(context.seed) {}

CoreExtraction::~CoreExtraction() {
  if (context_.raises == nullptr) return;
  const bool is_former_better =
      best_relaxation_ && (!relaxation_ || best_relaxation_->bound() > relaxation_->bound());
  Relaxation* const best = is_former_better ? best_relaxation_.get() : relaxation_.get();
  if (best != nullptr) context_.raises->swap(best->raises());
}

Outcome CoreExtraction::advance(Slice slice) {
  while (true) {
    context_.bounds.raise(relaxation_->bound());
    relaxation_->note_bound();
    context_.yield_point.yield();
    if (context_.limits.exhausted_now() || context_.bounds.are_closed()) return Outcome::stopped;
    const Verdict verdict = solve(slice);
    if (verdict == Verdict::sat) return Outcome::found;
    if (verdict == Verdict::unknown) {
      if (context_.limits.exhausted_now() || context_.bounds.are_closed()) return Outcome::stopped;
      if (!in_passes()) return Outcome::working;
      if (!end_pass()) return Outcome::stopped;
      continue;
    }
    std::vector<Lit> core = minimiser_.minimise(ordered(context_.engine.core()), conflicts_);
    const Cost lift = minimiser_.raise(*relaxation_, core, max_lift(), conflicts_);
    if (core.empty()) return Outcome::exhausted;
    ++statistics_.cores;
    if (!relaxation_->relax(core, lift)) return Outcome::stopped;
  }
}

std::vector<Lit> CoreExtraction::ordered(std::vector<Lit> core) {
  if (context_.seed != 0) order_.shuffle_front(core, core.size());
  return core;
}

/// More than up to the incumbent is of no use, and without one there is an end as well.
Cost CoreExtraction::max_lift() const {
  if (!options_.raise_cores) return 1;
  const auto best = context_.bounds.upper();
  const Cost most = context_.settings.core_most_lift;
  return best ? std::min(*best - relaxation_->bound(), most) : most;
}

Verdict CoreExtraction::solve(Slice slice) {
  const std::int64_t before = context_.limits.conflicts();
  const Settings& settings = context_.settings;
  if (in_passes()) {
    slice.conflicts = settings.core_turn;
    if (pass_ > 0)
      slice.conflicts =
          std::max<std::int64_t>(1, settings.core_turn / settings.core_later_turn_part);
  }
  const Verdict verdict = find_plan(context_, relaxation_->assumptions(), slice.conflicts);
  conflicts_ += context_.limits.conflicts() - before;
  return verdict;
}

bool CoreExtraction::start_pass() {
  relaxation_ = std::make_unique<Relaxation>(context_.engine, context_.problem, context_.limits);
  if (context_.raises != nullptr) relaxation_->keep_raises();
  pass_begin_ = conflicts_;
  return relaxation_->start();
}

/// Goes back to the start, or, after the last pass, to the best of all.
bool CoreExtraction::end_pass() {
  const std::int64_t conflicts = conflicts_ - pass_begin_;
  const bool is_best =
      !best_relaxation_ || relaxation_->bound() > best_relaxation_->bound() ||
      (relaxation_->bound() == best_relaxation_->bound() && conflicts < best_conflicts_);
  if (is_best) {
    best_relaxation_.swap(relaxation_);
    best_conflicts_ = conflicts;
  }
  passes_without_gain_ = is_best ? 0 : passes_without_gain_ + 1;
  if (relaxation_) relaxation_->retire();
  ++pass_;
  const Settings& settings = context_.settings;
  if (passes_without_gain_ == settings.core_vain_passes) pass_ = settings.core_passes;
  if (in_passes()) return start_pass();
  relaxation_ = std::move(best_relaxation_);
  return true;
}

}  // namespace quadrille::sat
