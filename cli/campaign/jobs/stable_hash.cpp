// SPDX-License-Identifier: MIT
#include "campaign/jobs/stable_hash.hpp"

#include <fmt/format.h>

namespace quadrille::cli::campaign {

std::uint64_t StableHash::value() const {
  std::uint64_t mixed = state_;
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9U;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebU;
  return mixed ^ (mixed >> 31);
}

std::string StableHash::hex() const { return fmt::format("{:016x}", value()); }

}  // namespace quadrille::cli::campaign
