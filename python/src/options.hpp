// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <string_view>

#include "errors.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/stated_outcome.hpp"
#include "quadrille/core/statistics.hpp"

namespace quadrille::python {

namespace py = pybind11;

/// The arguments of quadrille.solve that were given, by name. Each is taken once; one that nobody
/// takes does not apply to the domain.
class Arguments {
 public:
  explicit Arguments(const py::dict& given) : left_(given.attr("copy")()) {}

  /// nullopt if it was not given. Raises TypeError for a value of another type.
  template <class T>
  std::optional<T> take(const char* name) {
    const py::object value = left_.attr("pop")(name, py::none());
    if (value.is_none()) return std::nullopt;
    try {
      return value.cast<T>();
    } catch (const py::cast_error&) {
      throw py::type_error(std::string(name) + ": " + py::repr(value).cast<std::string>() +
                           " is of another type than expected");
    }
  }
  template <class T>
  void set(const char* name, T& value) {
    if (auto given = take<T>(name)) value = *std::move(given);
  }
  template <class T>
  void set(const char* name, std::optional<T>& value) {
    if (auto given = take<T>(name)) value = *std::move(given);
  }
  /// One of `names`, as `parse` understands them.
  template <class Choice, class Target>
  void choose(const char* name, std::optional<Choice> (*parse)(std::string_view), Target& target,
              const char* names) {
    const auto text = take<std::string>(name);
    if (!text) return;
    const auto choice = parse(*text);
    if (!choice) refuse(std::string(name) + ": '" + *text + "' is not " + names);
    target = *choice;
  }
  /// A number that is not negative, in the type of the library's options.
  template <class Number>
  void set_natural(const char* name, Number& value) {
    const auto given = take<std::int64_t>(name);
    if (!given) return;
    value = static_cast<Number>(*given);
    if (*given < 0 || static_cast<std::int64_t>(value) != *given)
      refuse(std::string(name) + ": " + std::to_string(*given) + " is out of range");
  }
  void finish(const char* domain) const {
    if (!left_.empty())
      refuse(py::str(left_.begin()->first).cast<std::string>() + " does not apply to " + domain);
  }

 private:
  py::dict left_;
};

/// What both domains have.
template <class Options>
void set_common(Arguments& arguments, Options& options, const std::atomic<bool>& interrupt) {
  arguments.choose("objective", parse_objective, options.objective, "sum-of-costs or makespan");
  const auto limit = [&](const char* name, std::optional<double>& value) {
    arguments.set(name, value);
    if (value && !(*value >= 0))
      refuse(std::string(name) + ": a limit is 0 or more, not " + std::to_string(*value));
  };
  limit("time_limit", options.limits.wall_s);
  limit("cpu_limit", options.limits.cpu_s);
  limit("memory_limit", options.limits.memory_mib);
  arguments.set("conflict_limit", options.limits.conflicts);
  arguments.set("gap", options.gap_percent);
  arguments.set_natural("seed", options.seed);
  arguments.set_natural("threads", options.threads);
  arguments.set("race", options.race);
  arguments.set("explain", options.explain);
  arguments.set("audit", options.debug.audit);
  arguments.set("progress_interval", options.progress_interval_s);
  arguments.set("plan_interval", options.plan_interval_s);
  options.limits.interrupt = &interrupt;
}

inline py::dict statistics_of(const Statistics& statistics) {
  py::dict dict;
  dict["cpu_s"] = statistics.cpu_s;
  dict["wall_s"] = statistics.wall_s;
  dict["peak_rss_mib"] = statistics.peak_rss_mib;
  dict["sat_calls"] = statistics.sat_calls;
  dict["conflicts"] = statistics.conflicts;
  dict["decisions"] = statistics.decisions;
  dict["variables"] = statistics.variables;
  dict["clauses"] = statistics.clauses;
  dict["collision_clauses"] = statistics.collision_clauses;
  dict["checks"] = statistics.checks;
  dict["models_checked"] = statistics.models_checked;
  dict["rejected_models"] = statistics.rejected_models;
  dict["cores"] = statistics.cores;
  dict["first_plan"] = statistics.first_plan;
  return dict;
}

}  // namespace quadrille::python
