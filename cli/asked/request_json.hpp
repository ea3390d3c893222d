// SPDX-License-Identifier: MIT
#pragma once

#include "answers/report.hpp"
#include "asked/solve_arguments.hpp"
#include "quadrille/core/request.hpp"

namespace quadrille::cli {

/// What can be asked in either domain, by the names of the options.
template <class Plan>
void add_request(Json& json, const SolveArguments& arguments, const Request<Plan>& request) {
  json["initial_plan"] = text_or_null(arguments.initial_plan);
  json["known_bound"] = or_null(arguments.known_bound);
  json["gap"] = or_null(request.gap_percent);
  json["threads"] = request.threads;
  json["race"] = request.race;
  json["explain"] = request.explain;
  json["proof"] = text_or_null(arguments.proof);
  json["seed"] = request.seed;
  add_limits(json, request.limits);
  json["audit"] = request.debug.audit;
  json["known_plan"] = text_or_null(arguments.known_plan);
}

}  // namespace quadrille::cli
