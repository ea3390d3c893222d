// SPDX-License-Identifier: MIT
#include "quadrille/continuous/plan_files.hpp"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <istream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <sstream>
#include <utility>

namespace quadrille::continuous {
namespace {

using Json = nlohmann::json;

std::optional<Error> finish(std::ostream& out, const std::string& file) {
  out.flush();
  if (out) return std::nullopt;
  return Error{ErrorCode::io, "cannot be written", {file, 0}};
}

class PlanReader {
 public:
  explicit PlanReader(std::string file) : file_(std::move(file)) {}

  Result<Plan> read(const std::string& text, double resolution) {
    Json json;
    try {
      json = Json::parse(text);
    } catch (const Json::parse_error& error) {
      const auto end =
          text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
      return Error{ErrorCode::syntax,
                   "not valid JSON",
                   {file_, 1 + static_cast<long>(std::count(text.begin(), end, '\n'))}};
    } catch (const Json::exception&) {
      return fail("", "not valid JSON");
    }
    if (!has_keys(json, {"version", "resolution", "paths"}))
      return fail("", "a plan has the keys version, resolution and paths");
    if (json["version"] != kPlanJsonVersion) return fail("/version", "not a supported version");
    if (!json["resolution"].is_number()) return fail("/resolution", "not a number");
    if (json["resolution"].get<double>() != resolution)
      return Error{
          ErrorCode::invalid_plan, "/resolution: not the resolution of the instance", {file_, 0}};
    if (!json["paths"].is_array()) return fail("/paths", "not a list");
    Plan plan;
    for (const Json& item : json["paths"]) {
      const std::string place = "/paths/" + std::to_string(plan.paths.size());
      if (!item.is_array()) return fail(place, "not a list");
      Path path;
      for (std::size_t k = 0; k < item.size(); ++k) {
        Stop stop;
        if (auto error =
                read_stop(item[k], place + "/" + std::to_string(k), k + 1 == item.size(), stop))
          return *error;
        path.push_back(stop);
      }
      plan.paths.push_back(std::move(path));
    }
    return plan;
  }

 private:
  [[nodiscard]] Error fail(const std::string& place, const std::string& message) const {
    return {ErrorCode::syntax, place.empty() ? message : place + ": " + message, {file_, 0}};
  }

  static bool has_keys(const Json& json, const std::set<std::string>& keys) {
    if (!json.is_object() || json.size() != keys.size()) return false;
    for (const std::string& key : keys)
      if (!json.contains(key)) return false;
    return true;
  }

  std::optional<Error> read_stop(const Json& json, const std::string& place, bool is_last,
                                 Stop& stop) const {
    const std::set<std::string> keys = is_last
                                           ? std::set<std::string>{"vertex", "arrive"}
                                           : std::set<std::string>{"vertex", "arrive", "depart"};
    if (!has_keys(json, keys))
      return fail(place, is_last ? "the last stop has the keys vertex and arrive"
                                 : "a stop has the keys vertex, arrive and depart");
    for (const std::string& key : keys)
      if (!json[key].is_number_integer() || json[key] < 0 ||
          json[key] > (key == "vertex" ? std::int64_t{0xffffffff} : std::int64_t{1} << 60))
        return fail(place + "/" + key, "not a natural number that is supported");
    stop.vertex = VertexId(json["vertex"].get<std::size_t>());
    stop.arrive = json["arrive"].get<Ticks>();
    stop.depart = is_last ? stop.arrive : json["depart"].get<Ticks>();
    return std::nullopt;
  }

  const std::string file_;
};

}  // namespace

Result<Plan> read_plan_json(std::istream& in, const std::string& file, double resolution) {
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) return Error{ErrorCode::io, "cannot be read", {file, 0}};
  return PlanReader(file).read(text, resolution);
}

Result<Plan> read_plan_json(const std::filesystem::path& path, double resolution) {
  std::error_code problem;
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path, problem))
    return Error{ErrorCode::io, "cannot be opened", {path.string(), 0}};
  return read_plan_json(in, path.string(), resolution);
}

std::optional<Error> write_plan_json(std::ostream& out, const std::string& file, const Plan& plan,
                                     double resolution) {
  out << "{\"version\": " << kPlanJsonVersion << ", \"resolution\": " << Json(resolution).dump()
      << ", \"paths\": [";
  const char* before_path = "\n  [";
  for (const Path& path : plan.paths) {
    out << before_path;
    before_path = ",\n  [";
    for (std::size_t k = 0; k < path.size(); ++k) {
      out << (k == 0 ? "" : ", ") << "{\"vertex\": " << path[k].vertex.index()
          << ", \"arrive\": " << path[k].arrive;
      if (k + 1 < path.size()) out << ", \"depart\": " << path[k].depart;
      out << "}";
    }
    out << "]";
  }
  out << "\n]}\n";
  return finish(out, file);
}

std::optional<Error> write_ccbs_log(std::ostream& out, const std::string& file,
                                    const Instance& instance, const Plan& plan,
                                    const GridRoadmap* grid, double seconds) {
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  const auto time = [&](Ticks ticks) { return static_cast<double>(ticks) * instance.resolution(); };
  const auto place = [&](const char* end, VertexId v) {
    text << " " << end;
    if (grid == nullptr)
      text << "_id=\"" << v.index() << "\"";
    else
      text << "_i=\"" << grid->cell(v).row << "\" " << end << "_j=\"" << grid->cell(v).column
           << "\"";
  };
  text << "<?xml version=\"1.0\"?>\n<root>\n<log>\n <summary time=\"" << seconds << "\" flowtime=\""
       << time(cost(plan, Objective::sum_of_costs)) << "\" makespan=\""
       << time(cost(plan, Objective::makespan)) << "\"/>\n";
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    const Path& path = plan.paths[AgentId(i)];
    text << " <agent number=\"" << i << "\">\n  <path duration=\"" << time(cost(path)) << "\">\n";
    int number = 0;
    const auto section = [&](VertexId from, VertexId to, Ticks duration) {
      text << "   <section number=\"" << number++ << "\"";
      place("start", from);
      place("goal", to);
      text << " duration=\"" << time(duration) << "\"/>\n";
    };
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const Ticks wait = path[k].depart - path[k].arrive;
      if (wait > 0) section(path[k].vertex, path[k].vertex, wait);
      section(path[k].vertex, path[k + 1].vertex, path[k + 1].arrive - path[k].depart);
    }
    text << "  </path>\n </agent>\n";
  }
  text << "</log>\n</root>\n";
  out << text.str();
  return finish(out, file);
}

}  // namespace quadrille::continuous
