// SPDX-License-Identifier: MIT
#include "campaign/run/row.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "campaign/jobs/whole.hpp"
#include "campaign/run/plan_text.hpp"
#include "frame/exit_codes.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::cli::campaign {
namespace {

using Json = nlohmann::ordered_json;

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "";
  return name.data();
}

Json or_null(const std::optional<std::int64_t>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json member(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found == json.end() ? Json(nullptr) : *found;
}

const char* stop_reason_of(Enforced enforced) {
  switch (enforced) {
    case Enforced::cpu_time:
      return "cpu-time";
    case Enforced::wall_time:
      return "wall-time";
    case Enforced::memory:
      return "memory";
    case Enforced::no:
      break;
  }
  return "none";
}

std::optional<std::string> status_of(int code) {
  switch (static_cast<ExitCode>(code)) {
    case ExitCode::success:
      return "optimal";
    case ExitCode::feasible:
      return "feasible";
    case ExitCode::infeasible:
      return "infeasible";
    case ExitCode::unknown:
      return "unknown";
    default:
      return std::nullopt;
  }
}

Row measured(const Job& job, const Ended& ended) {
  Row row;
  row.job = job.name;
  row.process_cpu_s = ended.cpu_s;
  row.wall_s = ended.wall_s;
  row.host = host_name();
  row.stop_reason = stop_reason_of(ended.enforced);
  row.enforced = ended.enforced != Enforced::no;
  return row;
}

/// The row of a program that has written a result. Throws Json's exceptions, and
/// std::runtime_error.
Row read_result(const Job& job, const Ended& ended, const std::string& status) {
  Row row = measured(job, ended);
  Json result = Json::parse(ended.out);
  result.at("status").get_to(row.status);
  if (row.status != status)
    throw std::runtime_error(fmt::format("exit code {} with status '{}'", ended.code, row.status));
  if (!row.enforced) result.at("stop_reason").get_to(row.stop_reason);
  result.at("explanation").get_to(row.explanation);
  row.cost = result.at("cost");
  row.lower_bound = result.at("lower_bound");
  const bool ticks = result.contains("cost_ticks");
  row.exact_cost = whole<std::int64_t>(ticks ? result["cost_ticks"] : row.cost);
  row.exact_bound = whole<std::int64_t>(ticks ? result.at("lower_bound_ticks") : row.lower_bound);
  row.statistics = result.at("statistics");
  result.at("version").get_to(row.version);
  row.history = member(result, "history");
  row.history_clock = result.value("history_clock", row.history_clock);
  row.certificate = member(result, "certificate");
  if (result.at("plan").is_null()) return row;
  if (auto encoded = ticks ? std::nullopt : encode_plan(result["plan"])) {
    row.plan = *std::move(encoded);
  } else {
    for (const char* key : {"statistics", "options", "history", "history_clock"}) result.erase(key);
    row.plan = std::move(result);
  }
  return row;
}

bool is_number_or_null(const Json& json) { return json.is_number() || json.is_null(); }

bool is_point(const Json& json) {
  return json.is_array() && json.size() == 3 && json[0].is_number() && is_number_or_null(json[1]) &&
         is_number_or_null(json[2]);
}

template <class Is>
bool are_all(const Json& json, const Is& is) {
  return json.is_array() && std::all_of(json.begin(), json.end(), is);
}

/// What cannot be worked with; null if all is well.
const char* fault_of(const Row& row) {
  constexpr std::array kStatuses = {"optimal", "infeasible", "feasible",
                                    "unknown", "failed",     "open"};
  if (row.job.size() != 16 || row.job.find_first_not_of("0123456789abcdef") != std::string::npos)
    return "no name of a job";
  if (std::find(kStatuses.begin(), kStatuses.end(), row.status) == kStatuses.end())
    return "no such status";
  if (!is_number_or_null(row.cost) || !is_number_or_null(row.lower_bound))
    return "a cost or bound is no number";
  if (!row.statistics.is_null() && !row.statistics.is_object())
    return "the statistics are no object";
  if (!row.history.is_null() && !are_all(row.history, is_point))
    return "the history is no list of seconds, bounds and costs";
  const bool texts = are_all(row.plan, [](const Json& path) { return path.is_string(); });
  if (!row.plan.is_null() && !row.plan.is_object() && !texts)
    return "the plan is neither a result nor a list of texts";
  return nullptr;
}

}  // namespace

Row failed_row(const Job& job, const Ended& ended, const std::string& why) {
  Row row = measured(job, ended);
  row.status = "failed";
  row.explanation = why;
  return row;
}

Row open_row(const Job& job) {
  Row row;
  row.job = job.name;
  row.status = "open";
  row.stop_reason = "none";
  row.host = host_name();
  return row;
}

std::optional<Row> make_row(const Job& job, const Ended& ended) {
  if (const auto status = status_of(ended.code)) {
    try {
      Row row = read_result(job, ended, *status);
      // Somebody's signal; if it had been for a limit, `enforced` would say so.
      if (!row.enforced && row.stop_reason == "interrupt") return std::nullopt;
      return row;
    } catch (const std::exception& error) {
      return failed_row(job, ended, std::string("not a result: ") + error.what());
    }
  }
  if (ended.enforced != Enforced::no) {
    Row row = measured(job, ended);
    row.status = "unknown";
    row.explanation = "ended from outside";
    return row;
  }
  if (ended.signal != 0) return std::nullopt;
  return failed_row(job, ended, fmt::format("exit code {}: {}", ended.code, ended.err));
}

std::string to_line(const Row& row) {
  const Json json = {{"job", row.job},
                     {"status", row.status},
                     {"stop_reason", row.stop_reason},
                     {"enforced", row.enforced},
                     {"explanation", row.explanation},
                     {"cost", row.cost},
                     {"lower_bound", row.lower_bound},
                     {"exact_cost", or_null(row.exact_cost)},
                     {"exact_bound", or_null(row.exact_bound)},
                     {"process_cpu_s", row.process_cpu_s},
                     {"wall_s", row.wall_s},
                     {"statistics", row.statistics},
                     {"version", row.version},
                     {"host", row.host},
                     {"certificate", row.certificate},
                     {"history", row.history},
                     {"history_clock", row.history_clock},
                     {"plan", row.plan}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<Row> read_row(std::string_view line) {
  try {
    const Json json = Json::parse(line);
    Row row;
    json.at("job").get_to(row.job);
    json.at("status").get_to(row.status);
    json.at("stop_reason").get_to(row.stop_reason);
    json.at("enforced").get_to(row.enforced);
    json.at("explanation").get_to(row.explanation);
    row.cost = json.at("cost");
    row.lower_bound = json.at("lower_bound");
    row.exact_cost = whole<std::int64_t>(json.at("exact_cost"));
    row.exact_bound = whole<std::int64_t>(json.at("exact_bound"));
    json.at("process_cpu_s").get_to(row.process_cpu_s);
    json.at("wall_s").get_to(row.wall_s);
    row.statistics = json.at("statistics");
    json.at("version").get_to(row.version);
    json.at("host").get_to(row.host);
    row.certificate = json.at("certificate");
    row.history = member(json, "history");
    row.history_clock = json.value("history_clock", row.history_clock);
    row.plan = member(json, "plan");
    if (const char* wrong = fault_of(row))
      return Error{ErrorCode::syntax, std::string("not a row: ") + wrong, {}};
    return row;
  } catch (const Json::exception& error) {
    return Error{ErrorCode::syntax, std::string("not a row: ") + error.what(), {}};
  }
}

}  // namespace quadrille::cli::campaign
