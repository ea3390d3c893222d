// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <tuple>
#include <vector>

#include "contacts/contacts.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/sat/certificate.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// When two agents are in each other's way, as far as it matters to what they do within their caps:
/// for certificates.
class PairContacts {
 public:
  explicit PairContacts(Scene& scene);  ///< Which outlives it.

  struct Party {
    AgentId agent;
    Cost most = 0;  ///< What it costs at most.
  };
  /// Writes what was not written before.
  void write(const Party& i, const Party& j, sat::CertificateWriter& writer);

 private:
  /// A move along an edge that begins at a tick from `first` to `last`.
  struct Move {
    EdgeId edge;
    Ticks first = 0, last = 0, duration = 0;
  };
  /// All that an agent can do, by edge and by vertex.
  struct Reach {
    AgentId agent;
    std::vector<Move> moves;          // by edge
    std::vector<std::size_t> places;  // by edge, of the moves; kNone
    std::vector<Ticks> arrivals;      // by vertex, the earliest; kForever
  };
  static constexpr std::size_t kNone = ~std::size_t{0};
  [[nodiscard]] Reach reach(const Party& party);
  void write_side(const Reach& x, const Reach& y, bool is_first, sat::CertificateWriter& writer);
  [[nodiscard]] bool is_new(ClassId a, EdgeId e, ClassId b, bool is_stay, std::size_t place);

  Scene& scene_;
  LimitMonitor unlimited_;
  Contacts contacts_;
  std::set<std::tuple<ClassId, EdgeId, ClassId, bool, std::size_t>> written_;
};

}  // namespace quadrille::continuous
