// SPDX-License-Identifier: MIT
#include "quadrille/exports/releasing.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "quadrille/execution/releaser.hpp"

namespace quadrille::exports {
namespace {

using Json = nlohmann::json;

/// Why a line of the stream says nothing about the plan.
enum class Foreign { robot, order, empty, broken };
struct PassedOver {
  Foreign kind;
  std::string what;  ///< Of an empty line nothing.
};

/// Counts the lines that are passed over.
class Leftovers {
 public:
  Leftovers(const std::string& file, const TakeWarning& warn) : file_(file), warn_(warn) {}

  void add(const PassedOver& line, std::size_t number) {
    Kind& kind = kinds_[static_cast<std::size_t>(line.kind)];
    ++kind.count;
    if (kind.count > 1) return;
    kind.first = number;
    say("passed over: " + (line.kind == Foreign::empty ? "an empty line" : line.what),
        static_cast<long>(number));
  }
  /// All of them in one line.
  void sum_up() const {
    static constexpr std::array<const char*, 4> kWhat = {"of robots that are not in the plan",
                                                         "of other orders", "empty", "broken"};
    std::size_t count = 0;
    std::string text;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      const Kind& kind = kinds_[k];
      if (kind.count == 0) continue;
      count += kind.count;
      text += (text.empty() ? "" : ", ") + std::to_string(kind.count) + " " + kWhat[k] +
              " (first in line " + std::to_string(kind.first) + ")";
    }
    if (count > 0)
      say(std::to_string(count) + (count == 1 ? " line" : " lines") + " passed over: " + text, 0);
  }

 private:
  struct Kind {
    std::size_t count = 0, first = 0;
  };
  void say(std::string text, long line) const {
    warn_({ErrorCode::syntax, std::move(text), {file_, line}});
  }

  const std::string& file_;
  const TakeWarning& warn_;
  std::array<Kind, 4> kinds_;
};

class Releasing {
 public:
  Releasing(const OrderWriter& writer, const execution::Precedences& order, const TakeOrder& take)
      : writer_(writer),
        order_(order),
        take_(take),
        releaser_(order),
        ended_(order.num_agents(), 0),
        sent_(order.num_agents(), Sent{}) {}

  void start() {
    (void)releaser_.take_news();
    for (const AgentId i : agent_ids()) send(i);
  }

  /// What there is to say of the line; an error: the robot went on without release.
  [[nodiscard]] Result<std::optional<PassedOver>> hear(const std::string& line) {
    const auto broken = [](std::string text) {
      return std::optional(PassedOver{Foreign::broken, std::move(text)});
    };
    if (line.find_first_not_of(" \t\r") == std::string::npos)
      return std::optional(PassedOver{Foreign::empty, ""});
    const Json state = Json::parse(line, nullptr, false);
    if (!state.is_object()) return broken("this is no JSON object");
    const auto has_text = [&](const char* key) {
      return state.contains(key) && state[key].is_string();
    };
    if (!has_text("serialNumber")) return broken("a state has a text 'serialNumber'");
    const std::string name = state["serialNumber"];
    const auto agent = find(name);
    if (!agent)
      return std::optional(
          PassedOver{Foreign::robot, "there is no robot '" + name + "' in the plan"});
    if (!has_text("orderId")) return broken("a state has a text 'orderId'");
    const std::string order = state["orderId"];
    if (order.empty()) return std::optional<PassedOver>();  // Not yet, or no more, on its way.
    if (order != writer_.names().orders[*agent])
      return std::optional(PassedOver{
          Foreign::order, "'" + name + "' follows the order '" + order + "' of somebody else"});
    if (!state.contains("lastNodeSequenceId") || !state["lastNodeSequenceId"].is_number_unsigned())
      return broken("a state has a number 'lastNodeSequenceId' that is not negative");
    const auto node = state["lastNodeSequenceId"].get<std::uint64_t>();
    if (node % 2 != 0) return broken("nodes have even numbers, and not " + std::to_string(node));
    if (node / 2 > releaser_.released(*agent))
      return Error{ErrorCode::syntax,
                   "'" + name + "' is at node " + std::to_string(node) +
                       " without release; the last one released is " +
                       std::to_string(2 * releaser_.released(*agent)),
                   {}};
    end_moves(*agent, static_cast<std::uint32_t>(node / 2));
    return std::optional<PassedOver>();
  }

  /// Nothing is left to do: all have arrived, or nobody reads the orders any more.
  [[nodiscard]] bool is_over() const { return !is_read_ || all_arrived(); }

 private:
  struct Sent {
    std::uint32_t updates = 0, released = 0;
  };

  [[nodiscard]] IdRange<AgentId> agent_ids() const { return IdRange<AgentId>(order_.num_agents()); }
  [[nodiscard]] std::optional<AgentId> find(const std::string& name) const {
    for (const AgentId i : agent_ids())
      if (writer_.names().robots[i] == name) return i;
    return std::nullopt;
  }

  [[nodiscard]] bool all_arrived() const {
    for (const AgentId i : agent_ids())
      if (ended_[i] < order_.moves[i].size()) return false;
    return true;
  }

  void end_moves(AgentId agent, std::uint32_t count) {
    if (count <= ended_[agent]) return;
    ended_[agent] = count;
    releaser_.end_moves(agent, count);
    for (const AgentId i : releaser_.take_news()) send(i);
  }

  void send(AgentId agent) {
    if (!is_read_) return;
    Sent& sent = sent_[agent];
    const std::uint32_t released = releaser_.released(agent);
    const std::string text = writer_.order(agent, {sent.released, released, sent.updates});
    ++sent.updates;
    sent.released = released;
    is_read_ = take_(text + "\n");
  }

  const OrderWriter& writer_;
  const execution::Precedences& order_;
  const TakeOrder& take_;
  execution::Releaser releaser_;
  IdVector<AgentId, std::uint32_t> ended_;
  IdVector<AgentId, Sent> sent_;
  bool is_read_ = true;
};

}  // namespace

std::optional<Error> release_orders(const OrderWriter& writer, const execution::Precedences& order,
                                    std::istream& states, const std::string& file,
                                    const TakeOrder& take, const TakeWarning& warn) {
  Releasing releasing(writer, order, take);
  Leftovers leftovers(file, warn);
  releasing.start();
  std::string line;
  for (std::size_t number = 1; !releasing.is_over() && std::getline(states, line); ++number) {
    const auto heard = releasing.hear(line);
    if (!heard) {
      leftovers.sum_up();
      Error error = heard.error();
      error.where.file = file;
      error.where.line = static_cast<long>(number);
      return error;
    }
    if (*heard) leftovers.add(**heard, number);
  }
  leftovers.sum_up();
  return std::nullopt;
}

}  // namespace quadrille::exports
