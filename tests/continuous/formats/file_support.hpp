// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "quadrille/core/result.hpp"

namespace quadrille::continuous::test {

/// The name of a file in tests/data/roadmaps.
inline std::string data(const std::string& name) {
  return std::string(QUADRILLE_TEST_DATA "/roadmaps/") + name;
}

inline std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  EXPECT_FALSE(text.str().empty()) << path;
  return text.str();
}

/// One change to a file that makes it wrong, and what the reader has to say.
struct Fault {
  const char* from;  ///< Found exactly once; empty: everything.
  std::string to;
  const char* message;  ///< How the message begins, with "f:<line>: ".
};

inline std::string with_fault(const std::string& text, const Fault& fault) {
  if (*fault.from == 0) return fault.to;
  const auto at = text.find(fault.from);
  EXPECT_NE(at, std::string::npos) << fault.from;
  if (at == std::string::npos) return text;
  EXPECT_EQ(text.find(fault.from, at + 1), std::string::npos) << fault.from << " is there twice";
  return std::string(text).replace(at, std::string(fault.from).size(), fault.to);
}

template <class Read>
void expect_refused(const std::string& valid, const std::vector<Fault>& faults, const Read& read) {
  for (const Fault& fault : faults) {
    const std::string text = with_fault(valid, fault);
    SCOPED_TRACE(text);
    std::istringstream in(text);
    const auto result = read(in);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().to_string().substr(0, std::string(fault.message).size()),
              fault.message);
  }
  // Whatever is cut off is missed.
  const std::size_t end = valid.find_last_not_of(" \n");
  for (std::size_t length = 0; length < end; length += 7) {
    std::istringstream in(valid.substr(0, length));
    EXPECT_FALSE(read(in).has_value()) << "the first " << length << " bytes";
  }
}

}  // namespace quadrille::continuous::test
