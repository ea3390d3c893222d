// SPDX-License-Identifier: MIT
#include "cli/files/contents.hpp"

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>
#include <vector>

namespace quadrille::cli::test {
namespace {

using nlohmann::json;

std::string why_no_text(const std::string& text) {
  try {
    static_cast<void>(json(text).dump());
  } catch (const json::exception&) {
    return "not UTF-8";
  }
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' && c != '\r')
      return "a control character";
  return "";
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) found.push_back(field);
  return found;
}

}  // namespace

std::string why_no_json(const std::string& text) { return json::accept(text) ? "" : "no JSON"; }

std::string why_no_xml(const std::string& text) {
  if (std::string why = why_no_text(text); !why.empty()) return why;
  pugi::xml_document document;
  const auto result = document.load_string(text.c_str());
  return result ? "" : result.description();
}

std::string why_no_page(const std::string& text) {
  if (std::string why = why_no_text(text); !why.empty()) return why;
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const auto at = text.find(begin);
  if (at == std::string::npos) return "no data";
  const auto from = at + begin.size(), to = text.find("</script>", from);
  if (to == std::string::npos) return "it is cut off";
  return why_no_json(text.substr(from, to - from));
}

std::string why_no_table(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line)) return "empty";
  const std::size_t columns = fields(line).size();
  while (std::getline(lines, line)) {
    const auto row = fields(line);
    if (row.size() != columns) return "a line with other fields than the first: " + line;
    for (const std::string& field : row)
      if (!json::accept(field)) return "no number: " + line;
  }
  return "";
}

json plan_in(const std::string& text) {
  json plan = json::parse(text).at("plan");
  for (json& path : plan) {
    if (path.empty() || path.front().is_object()) continue;
    while (path.size() > 1 && path[path.size() - 1] == path[path.size() - 2])
      path.erase(path.size() - 1);
  }
  return plan;
}

}  // namespace quadrille::cli::test
