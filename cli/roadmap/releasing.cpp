// SPDX-License-Identifier: MIT
#include "roadmap/releasing.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "quadrille/execution/releaser.hpp"
#include "roadmap/exports.hpp"

namespace quadrille::cli {
namespace {

using Json = nlohmann::json;

class Releasing {
 public:
  Releasing(const continuous::Instance& instance, const continuous::Plan& plan,
            const execution::Precedences& order, const TakeOrder& take)
      : instance_(instance),
        plan_(plan),
        take_(take),
        releaser_(order),
        ended_(order.num_agents(), 0),
        sent_(order.num_agents(), Sent{}) {}

  [[nodiscard]] bool start() {
    (void)releaser_.take_news();
    for (const AgentId i : instance_.agent_ids())
      if (!send(i)) return false;
    return true;
  }

  /// False: go no further. Errors: a text.
  [[nodiscard]] Result<bool> hear(const std::string& line) {
    const auto wrong = [](std::string text) {
      return Error{ErrorCode::syntax, std::move(text), {}};
    };
    const Json state = Json::parse(line, nullptr, false);
    if (!state.is_object()) return wrong("this is no JSON object");
    for (const char* key : {"serialNumber", "orderId"})
      if (!state.contains(key) || !state[key].is_string())
        return wrong(std::string("a state has a text '") + key + "'");
    if (!state.contains("lastNodeSequenceId") || !state["lastNodeSequenceId"].is_number_unsigned())
      return wrong("a state has a number 'lastNodeSequenceId' that is not negative");
    const std::string name = state["serialNumber"];
    const auto agent = find(name);
    if (!agent) return wrong("there is no robot '" + name + "' in the plan");
    if (state["orderId"] != order_name(*agent)) return true;  // Not yet, or no more, on its way.
    const auto node = state["lastNodeSequenceId"].get<std::uint64_t>();
    if (node % 2 != 0) return wrong("nodes have even numbers, and not " + std::to_string(node));
    if (node / 2 > releaser_.released(*agent))
      return wrong("'" + name + "' is at node " + std::to_string(node) +
                   " without release; the last one released is " +
                   std::to_string(2 * releaser_.released(*agent)));
    const auto ended = static_cast<std::uint32_t>(node / 2);
    if (ended <= ended_[*agent]) return true;
    ended_[*agent] = ended;
    releaser_.end_moves(*agent, ended);
    for (const AgentId i : releaser_.take_news())
      if (!send(i)) return false;
    return !all_arrived();
  }

  [[nodiscard]] bool all_arrived() const {
    for (const AgentId i : instance_.agent_ids())
      if (ended_[i] + 1 < plan_.paths[i].size()) return false;
    return true;
  }

 private:
  struct Sent {
    std::uint32_t updates = 0, released = 0;
  };

  [[nodiscard]] std::optional<AgentId> find(const std::string& name) const {
    for (const AgentId i : instance_.agent_ids())
      if (order_name(i) == name) return i;
    return std::nullopt;
  }

  bool send(AgentId agent) {
    Sent& sent = sent_[agent];
    const std::uint32_t released = releaser_.released(agent);
    const std::string text =
        export_order(instance_, agent, plan_.paths[agent], {sent.released, released, sent.updates});
    ++sent.updates;
    sent.released = released;
    return take_(text + "\n");
  }

  const continuous::Instance& instance_;
  const continuous::Plan& plan_;
  const TakeOrder& take_;
  execution::Releaser releaser_;
  IdVector<AgentId, std::uint32_t> ended_;
  IdVector<AgentId, Sent> sent_;
};

}  // namespace

std::optional<Error> release_orders(const continuous::Instance& instance,
                                    const continuous::Plan& plan,
                                    const execution::Precedences& order, std::istream& states,
                                    const std::string& file, const TakeOrder& take) {
  Releasing releasing(instance, plan, order, take);
  if (!releasing.start() || releasing.all_arrived()) return std::nullopt;
  std::string line;
  for (std::size_t number = 1; std::getline(states, line); ++number) {
    const auto goes_on = releasing.hear(line);
    if (!goes_on) {
      Error error = goes_on.error();
      error.where.file = file;
      error.where.line = static_cast<long>(number);
      return error;
    }
    if (!*goes_on) break;
  }
  return std::nullopt;
}

}  // namespace quadrille::cli
