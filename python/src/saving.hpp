// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "errors.hpp"

namespace quadrille::python {

/// Writes a file by `write`, a function from a stream to an optional Error.
template <class Write>
void save(const std::filesystem::path& path, const Write& write) {
  std::ofstream out(path, std::ios::binary);
  if (!out)
    raise(
        {ErrorCode::io, std::string("cannot write: ") + std::strerror(errno), {path.string(), 0}});
  check(write(out));
}

}  // namespace quadrille::python
