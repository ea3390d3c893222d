// SPDX-License-Identifier: MIT
#include "quadrille/text/plan_header.hpp"

#include <string>
#include <string_view>
#include <vector>

#include "quadrille/text/text_input.hpp"

namespace quadrille::text {

bool PlanHeader::read(std::initializer_list<Checker::Member> more, StatedOutcome& stated) {
  std::optional<Node> unread[11];  // Of a result.
  std::vector<Checker::Member> members = {{"quadrille", &kind_, false},
                                          {"version", &version_, false},
                                          {"objective", &objective_, false},
                                          {"cost", &cost_, false},
                                          {"plan", &plan_, false},
                                          {"agents", &agents_, false},
                                          {"status", &status_, false},
                                          {"lower_bound", &bound_, false},
                                          {"gap_percent", &gap_, false},
                                          {"statistics", &unread[0], false},
                                          {"seed", &unread[1], false},
                                          {"options", &unread[2], false},
                                          {"stop_reason", &unread[3], false},
                                          {"internal_error", &unread[4], false},
                                          {"explanation", &unread[5], false},
                                          {"history", &unread[6], false},
                                          {"history_clock", &unread[10], false},
                                          {"attribution", &unread[7], false},
                                          {"reasons", &unread[8], false},
                                          {"rests_on_known_bound", &unread[9], false}};
  members.insert(members.end(), more);
  return check_.members(Document::kRoot, members) && read_kind(stated) && read_objective(stated) &&
         read_gap(stated);
}

bool PlanHeader::read_kind(StatedOutcome& stated) {
  // A plan states its own version; a result has a status, and the version is the program's.
  std::string_view name = status_ ? "result" : "plan", text;
  if (kind_ && !check_.text(*kind_, name)) return false;
  if (status_) {
    if (!check_.text(*status_, text)) return false;
    stated.status = parse_status(text);
    if (!stated.status)
      return check_.fail(
          *status_,
          "expected 'optimal', 'feasible', 'infeasible' or 'unknown', found " + in_quotes(text));
  }
  if (name == "result") return true;
  if (name != "plan")
    return check_.fail(*kind_, "expected 'plan' or 'result', found " + in_quotes(name));
  if (!version_) return check_.fail(Document::kRoot, "the key 'version' is missing");
  std::int64_t number = 0;
  return check_.integer(*version_, kPlanJsonVersion, kPlanJsonVersion, number);
}

bool PlanHeader::read_objective(StatedOutcome& stated) {
  if (!objective_) return true;
  std::string_view name;
  if (!check_.text(*objective_, name)) return false;
  const auto known = parse_objective(name);
  if (!known)
    return check_.fail(*objective_,
                       "expected 'sum-of-costs' or 'makespan', found " + in_quotes(name));
  stated.objective = *known;
  return true;
}

bool PlanHeader::read_gap(StatedOutcome& stated) {
  return is_null(gap_) || check_.number(*gap_, stated.gap_percent.emplace());
}

bool PlanHeader::is_null(const std::optional<Node>& node) const {
  return !node || document_.kind(*node) == Document::Kind::null;
}

bool PlanHeader::needs_objective(Node node, const std::string& what) {
  return objective_ || check_.fail(node, what + " needs the key 'objective'");
}

bool PlanHeader::plan(Node& paths) {
  if (is_null(plan_))
    return check_.fail(plan_.value_or(Document::kRoot), ErrorCode::invalid_plan,
                       "there is no plan");
  paths = *plan_;
  return check_.array(paths, "paths");
}

bool PlanHeader::agents(std::size_t num_paths) {
  if (!agents_) return true;
  std::int64_t count = 0;
  if (!check_.integer(*agents_, 0, INT64_MAX, count)) return false;
  return count == static_cast<std::int64_t>(num_paths) ||
         check_.fail(
             *agents_, ErrorCode::invalid_plan,
             std::to_string(count) + " agents, but " + std::to_string(num_paths) + " paths");
}

}  // namespace quadrille::text
