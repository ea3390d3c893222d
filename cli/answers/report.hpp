// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "frame/exit_codes.hpp"
#include "quadrille/core/certificate.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/core/statistics.hpp"

namespace quadrille::cli {

/// The exit code that says what the outcome says.
[[nodiscard]] ExitCode exit_code(Status status);
template <class Outcome>
[[nodiscard]] ExitCode exit_code_of(const Outcome& outcome) {
  return outcome.internal_error ? ExitCode::internal : exit_code(outcome.status);
}

/// The first violations, one per line, and how many more there are.
template <class VerifyReport>
[[nodiscard]] std::string describe_violations(const VerifyReport& check) {
  constexpr std::size_t kShown = 100;
  std::string text;
  const std::size_t shown = std::min(kShown, check.violations.size());
  for (std::size_t i = 0; i < shown; ++i) text += check.violations[i].message + "\n";
  if (shown < check.violations.size())
    text += "... and " + std::to_string(check.violations.size() - shown) + " more\n";
  return text;
}

/// What the human output says of an outcome, its costs as they are to be printed.
struct OutcomeText {
  Status status = Status::unknown;
  StopReason stop = StopReason::none;
  std::string explanation;
  Objective objective = Objective::sum_of_costs;
  std::optional<std::string> cost;
  std::string lower_bound;
  bool rests_on_known_bound = false;
  double gap_percent = 0;  ///< Between them, if there is a cost.
  Statistics statistics;
};
/// ", gap 1.25 %"; empty where it is 0 or infinite.
[[nodiscard]] std::string gap_text(double gap_percent);

/// The lines "result", "why", "cost" and "search" of the human output.
[[nodiscard]] std::string describe(const OutcomeText& outcome);
/// `print`: how a cost is written.
template <class Outcome, class Print>
[[nodiscard]] std::string describe_result(const Outcome& outcome, Objective objective,
                                          const Print& print) {
  OutcomeText text{outcome.status,
                   outcome.stop,
                   outcome.explanation,
                   objective,
                   {},
                   print(outcome.lower_bound),
                   outcome.rests_on_known_bound,
                   0,
                   outcome.statistics};
  if (outcome.cost) {
    text.cost = print(*outcome.cost);
    text.gap_percent = gap_percent(*outcome.cost, outcome.lower_bound);
  }
  return describe(text);
}

using Json = nlohmann::ordered_json;

template <class T>
[[nodiscard]] Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
/// What is said of a certificate; null if there is nothing to say. `to_json(claim)`: an object with
/// the claim, which is absent if there is no plan.
template <class ToJson>
[[nodiscard]] Json proof_json(const CertifiedOutcome& outcome, const ToJson& to_json) {
  if (!outcome.no_certificate.empty()) return {{"none", outcome.no_certificate}};
  if (!outcome.certificate) return nullptr;
  Json json = to_json(outcome.certificate->claim);
  json["bytes"] = outcome.certificate->bytes.size();
  return json;
}
/// The same as a line of text; `print(claim)`.
template <class Print>
[[nodiscard]] std::string describe_proof(const CertifiedOutcome& outcome, const Print& print) {
  if (!outcome.no_certificate.empty()) return "proof      none: " + outcome.no_certificate + "\n";
  if (!outcome.certificate) return "";
  const Certificate& made = *outcome.certificate;
  return "proof      no plan" + (made.claim ? " costs less than " + print(*made.claim) : "") +
         ", " + std::to_string(made.bytes.size()) + " bytes\n";
}
/// null for an empty text.
[[nodiscard]] Json text_or_null(const std::string& text);
/// "time_limit" and so on.
void add_limits(Json& options, const Limits& limits);

/// A JSON object with one key per line.
class JsonLines {
 public:
  /// `what`: the value of the key "quadrille", which comes first.
  explicit JsonLines(std::string_view what) { add("quadrille", what); }

  void add(std::string_view key, const Json& value);
  /// A list with one item per line.
  template <class List, class ToJson>
  void add_list(std::string_view key, const List& list, const ToJson& to_json) {
    std::string text = "[";
    for (const auto& item : list)
      text += (text == "[" ? "\n    " : ",\n    ") + on_one_line(to_json(item));
    add_text(key, text + (text == "[" ? "]" : "\n  ]"));
  }
  [[nodiscard]] std::string finish() const { return text_ + "\n}\n"; }

 protected:
  /// `json`: JSON as text.
  void add_text(std::string_view key, std::string_view json);

 private:
  /// Bytes that are not UTF-8, as file names may have, are replaced.
  static std::string on_one_line(const Json& json);

  std::string text_ = "{";
};

/// The result of a solve as JSON, documented in docs/cli.md.
class ResultJson : public JsonLines {
 public:
  ResultJson(Status status, Objective objective);

  /// "gap_percent": null without a plan, and where it is infinite.
  template <class Outcome>
  void add_gap(const Outcome& outcome) {
    Json gap;
    if (outcome.cost && (outcome.lower_bound > 0 || *outcome.cost == 0))
      gap = gap_percent(*outcome.cost, outcome.lower_bound);
    add("gap_percent", gap);
  }
  /// "stop_reason", "explanation" and "internal_error".
  template <class Outcome>
  void add_end_of_search(const Outcome& outcome) {
    add("stop_reason", to_string(outcome.stop));
    add("explanation", outcome.explanation);
    add("internal_error",
        outcome.internal_error ? Json(outcome.internal_error->to_string()) : Json(nullptr));
  }
  /// The last keys, from "statistics" to "plan". `plan`: JSON, or "null".
  [[nodiscard]] std::string finish(const Statistics& statistics, std::uint32_t seed,
                                   const Json& options, const std::string& plan);
};

}  // namespace quadrille::cli
