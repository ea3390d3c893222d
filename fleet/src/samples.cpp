// SPDX-License-Identifier: MIT
#include "quadrille/fleet/samples.hpp"

#include <nlohmann/json.hpp>
#include <ostream>

#include "numbers.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::fleet {
namespace {

/// A field of RFC 4180.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

/// What is not UTF-8 is replaced.
std::string json_string(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Without heights in the plane.
std::string numbers(const Sample& sample, bool is_flat, const char* separator) {
  const auto& [x, y, z] = sample.position;
  const auto& [vx, vy, vz] = sample.velocity;
  std::string text = shortest(sample.time.value());
  const auto add = [&](auto value) { text += separator + shortest(value.value()); };
  add(x);
  add(y);
  if (!is_flat) add(z);
  add(vx);
  add(vy);
  if (!is_flat) add(vz);
  return text;
}

}  // namespace

std::optional<Error> write_samples_csv(std::ostream& out, const std::string& file,
                                       const TimedPlan& plan, Hertz rate) {
  const bool is_flat = plan.instance().is_flat();
  out << (is_flat ? "robot,time_s,x_m,y_m,vx_mps,vy_mps\n"
                  : "robot,time_s,x_m,y_m,z_m,vx_mps,vy_mps,vz_mps\n");
  for (const AgentId robot : plan.robot_ids()) {
    const std::string name = csv_field(plan[robot].name());
    for (const Sample& sample : plan[robot].samples(rate))
      out << name << "," << numbers(sample, is_flat, ",") << "\n";
  }
  return text::finish_output(out, file);
}

std::optional<Error> write_samples_json(std::ostream& out, const std::string& file,
                                        const TimedPlan& plan, Hertz rate) {
  out << "{\n  \"quadrille\": \"samples\",\n  \"version\": " << kSamplesJsonVersion
      << ",\n  \"rate_hz\": " << shortest(rate.value()) << ",\n  \"robots\": [";
  const bool is_flat = plan.instance().is_flat();
  const char* next_robot = "\n";
  for (const AgentId robot : plan.robot_ids()) {
    out << next_robot << "    {\"name\": " << json_string(plan[robot].name()) << ", \"samples\": [";
    next_robot = ",\n";
    const char* next_sample = "\n";
    for (const Sample& sample : plan[robot].samples(rate)) {
      out << next_sample << "      [" << numbers(sample, is_flat, ", ") << "]";
      next_sample = ",\n";
    }
    out << "\n    ]}";
  }
  out << (*next_robot == ',' ? "\n  ]\n}\n" : "]\n}\n");
  return text::finish_output(out, file);
}

}  // namespace quadrille::fleet
