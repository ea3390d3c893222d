// SPDX-License-Identifier: MIT
#include "campaign/jobs/glob.hpp"

#include <glob.h>

#include <algorithm>

namespace quadrille::cli::campaign {

Result<std::vector<std::string>> matching_files(const std::string& pattern) {
  glob_t found{};
  // The order of glob depends on the language; bytes do not.
  const int code = ::glob(pattern.c_str(), GLOB_NOSORT | GLOB_ERR, nullptr, &found);
  std::vector<std::string> files;
  if (code == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (code == GLOB_NOMATCH || (code == 0 && files.empty()))
    return Error{ErrorCode::io, "no file matches " + pattern, {}};
  if (code != 0) return Error{ErrorCode::io, "a folder cannot be read for " + pattern, {}};
  std::sort(files.begin(), files.end());
  return files;
}

std::string substitute(std::string pattern, const std::string& name, const std::string& value) {
  std::string literal;
  for (const char c : value) {
    if (c == '*' || c == '?' || c == '[' || c == '\\') literal += '\\';
    literal += c;
  }
  const std::string hole = "{" + name + "}";
  for (std::size_t at = 0; (at = pattern.find(hole, at)) != std::string::npos; at += literal.size())
    pattern.replace(at, hole.size(), literal);
  return pattern;
}

}  // namespace quadrille::cli::campaign
