// SPDX-License-Identifier: MIT
#include "reservations/soft_reservations.hpp"

#include <algorithm>

namespace quadrille::discrete {

const SoftReservations::Piece SoftReservations::kEmpty{};

void SoftReservations::add(AgentId agent, const Path& path) {
  for_each_stay(agent, path, [&](VertexId v, const Stay& stay) {
    auto& [stays, pieces] = cells_[v];
    const auto after = std::partition_point(
        stays.begin(), stays.end(), [&](const Stay& other) { return other.begin <= stay.begin; });
    stays.insert(after, stay);
    if (pieces.empty()) pieces.push_back({});
    std::size_t at = split(pieces, stay.begin);
    ++pieces[at].begins;
    if (stay.end != kForever) ++pieces[split(pieces, stay.end + 1)].ends;
    for (; at < pieces.size() && pieces[at].begin <= stay.end; ++at) ++pieces[at].present;
  });
}

void SoftReservations::remove(AgentId agent, const Path& path) {
  for_each_stay(agent, path, [&](VertexId v, const Stay& stay) {
    auto& [stays, pieces] = cells_[v];
    auto it = std::partition_point(stays.begin(), stays.end(),
                                   [&](const Stay& other) { return other.begin < stay.begin; });
    while (it->agent != agent) ++it;
    stays.erase(it);
    std::size_t at = piece_at(pieces, stay.begin);
    --pieces[at].begins;
    for (; at < pieces.size() && pieces[at].begin <= stay.end; ++at) --pieces[at].present;
    if (stay.end != kForever) {
      --pieces[at].ends;
      join(pieces, stay.end + 1);
    }
    join(pieces, stay.begin);
  });
}

void SoftReservations::clear() {
  for (Cell& cell : cells_) {
    cell.stays.clear();
    cell.pieces.clear();
  }
}

std::uint32_t SoftReservations::swaps(VertexId from, VertexId to, Timestep arrival) const {
  std::uint32_t count = 0;
  for (const Stay& stay : stays(to)) {
    if (stay.begin >= arrival) break;
    if (stay.end == arrival - 1 && stay.next == from) ++count;
  }
  return count;
}

/// Makes a piece begin there. Returns its index.
std::size_t SoftReservations::split(std::vector<Piece>& pieces, Timestep begin) {
  const std::size_t at = piece_at(pieces, begin);
  if (pieces[at].begin == begin) return at;
  const auto after = pieces.begin() + static_cast<std::ptrdiff_t>(at) + 1;
  pieces.insert(after, {begin, pieces[at].present, 0, 0});
  return at + 1;
}

/// Undoes a split that nothing needs any more.
void SoftReservations::join(std::vector<Piece>& pieces, Timestep begin) {
  const std::size_t at = piece_at(pieces, begin);
  if (at == 0 || pieces[at].begins > 0 || pieces[at].ends > 0) return;
  pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(at));
}

}  // namespace quadrille::discrete
