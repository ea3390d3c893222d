// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "cost/core_minimiser.hpp"
#include "cost/relaxation.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/sat/strategy.hpp"

namespace quadrille::sat {

/// The search from below: no soft constraint may be violated, and a core that says otherwise is
/// paid for (OLL). When a core is hard, extraction starts again with all that was learned, a few
/// times at most, and goes on from the best of these passes.
class CoreExtraction final : public Strategy {
 public:
  CoreExtraction(const CostSearchContext& context, const CoreGuidedOptions& options,
                 Statistics& statistics);
  /// Hands over what raised the bound in the best of the passes, if that is asked for.
  ~CoreExtraction() override;
  CoreExtraction(const CoreExtraction&) = delete;
  CoreExtraction& operator=(const CoreExtraction&) = delete;

  /// To be called first. False: a limit came before the soft constraints were made.
  [[nodiscard]] bool start() { return start_pass(); }
  /// Until a core takes more conflicts than the slice has. During the passes the options say how
  /// many these are.
  [[nodiscard]] Outcome advance(Slice slice) override;
  [[nodiscard]] const Relaxation& relaxation() const noexcept { return *relaxation_; }

 private:
  [[nodiscard]] bool in_passes() const noexcept { return pass_ < context_.settings.core_passes; }
  /// In the order in which it is tried whether it is needed.
  [[nodiscard]] std::vector<Lit> ordered(std::vector<Lit> core);
  /// Asks for a plan that violates nothing.
  [[nodiscard]] Verdict solve(Slice slice);
  [[nodiscard]] Cost max_lift() const;
  [[nodiscard]] bool start_pass();
  [[nodiscard]] bool end_pass();

  const CostSearchContext context_;
  const CoreGuidedOptions options_;
  Statistics& statistics_;
  CoreMinimiser minimiser_;
  Random order_;
  std::unique_ptr<Relaxation> relaxation_, best_relaxation_;
  std::int64_t pass_ = 0, passes_without_gain_ = 0;
  std::int64_t conflicts_ = 0;  // of `solve`
  std::int64_t pass_begin_ = 0, best_conflicts_ = 0;
};

}  // namespace quadrille::sat
