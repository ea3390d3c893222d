// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/stl.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "errors.hpp"
#include "quadrille/text/names.hpp"

namespace quadrille::python {

/// Writes a file by `write`, a function from a stream to an optional Error. What cannot be written
/// leaves the file as it is.
template <class Write>
void save(const std::filesystem::path& path, const Write& write) {
  std::ostringstream text;
  check(write(text));
  std::ofstream out(path, std::ios::binary);
  const auto fail = [&path] {
    raise(
        {ErrorCode::io, std::string("cannot write: ") + std::strerror(errno), {path.string(), 0}});
  };
  if (!out) fail();
  errno = 0;
  out << text.str() << std::flush;
  if (!out) fail();
}

/// The format of a file: the one that is named, or the one that its ending stands for, or else
/// JSON for a name without an ending. Raises InputError for other endings: what is in a file should
/// be what its name says. `known`: what the ending stands for, if anything; `formats`: for the
/// message.
template <class Format>
Format format_for(const std::filesystem::path& path, const std::optional<Format>& named,
                  const std::optional<Format>& known, const std::string& formats) {
  if (named || known) return named ? *named : *known;
  if (path.extension().empty()) return Format::json;
  raise({ErrorCode::out_of_range,
         "the ending '" + path.extension().string() + "' stands for none of the formats here; " +
             "format= names one: " + formats,
         {path.string(), 0}});
}

/// Agents, vertices, groups, each a list.
using NameLists = std::tuple<std::vector<std::optional<std::string>>, std::vector<std::string>,
                             std::vector<std::optional<std::string>>>;
inline text::Names names_of(const NameLists& lists) {
  return {std::get<0>(lists), std::get<1>(lists), std::get<2>(lists)};
}
inline NameLists lists_of(const text::Names& names) {
  return {names.agents, names.vertices, names.groups};
}

}  // namespace quadrille::python
