// SPDX-License-Identifier: MIT
#include "read/json.hpp"

#include <algorithm>

namespace quadrille_check {
namespace {

void expect(bool holds, const std::string& what) {
  if (!holds) throw BadInput("JSON: expected " + what);
}
bool is_digit(char c) { return c >= '0' && c <= '9'; }

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}
  Json document() {
    Json json = value(0);
    expect(next() == '\0' && at_ == text_.size(), "no more text");
    return json;
  }

 private:
  /// The next character that is no white space, which stays; 0 at the end.
  char next() {
    at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  char take() {
    const char c = next();
    ++at_;
    return c;
  }

  Json value(int depth) {
    expect(depth <= 32, "less depth");
    Json json;
    json.kind = is_digit(next()) ? '0' : text_.c_str()[at_];
    if (json.kind == '"') {
      json.content = text();
    } else if (json.kind == '{' || json.kind == '[') {
      read_members(json, depth);
    } else {
      expect(json.kind == '0', "an object, a list, a text or a natural number");
      const bool leads = text_[at_] == '0';
      for (; is_digit(text_.c_str()[at_]); ++at_) {
        expect(json.value < kEndOfTime && !(leads && at_ > 0 && is_digit(text_[at_ - 1])),
               "a smaller number, without leading zeros");
        json.value = 10 * json.value + (text_[at_] - '0');
      }
      const char c = text_.c_str()[at_];
      expect(c != '.' && c != 'e' && c != 'E', "a natural number");
    }
    return json;
  }

  void read_members(Json& json, int depth) {
    const char end = json.kind == '{' ? '}' : ']';
    std::set<std::string> keys;
    ++at_;
    if (next() == end) {
      ++at_;
      return;
    }
    for (char c = ','; c != end;) {
      if (json.kind == '{') {
        expect(next() == '"', "a key");
        json.names.push_back(text());
        expect(keys.insert(json.names.back()).second, "each key once");
        expect(take() == ':', "a colon");
      }
      json.members.push_back(value(depth + 1));
      c = take();
      expect(c == ',' || c == end, "a comma or an end");
    }
  }

  /// What an escape stands for matters to nobody: names are not used.
  std::string text() {
    const std::size_t begin = ++at_;
    for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      expect(static_cast<unsigned char>(text_[at_]) >= ' ', "no control character");
      if (text_[at_] == '\\') ++at_;
    }
    expect(at_ < text_.size(), "the end of a text");
    return text_.substr(begin, at_++ - begin);
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

const Json* Json::find(const std::string& key) const {
  expect(kind == '{', "an object");
  const auto at = std::find(names.begin(), names.end(), key);
  return at == names.end() ? nullptr : &members[static_cast<std::size_t>(at - names.begin())];
}
const Json& Json::at(const std::string& key) const {
  const Json* const found = find(key);
  expect(found != nullptr, "the key \"" + key + "\"");
  return *found;
}
void Json::only(const std::set<std::string>& keys) const {
  expect(kind == '{', "an object");
  for (const std::string& name : names) expect(keys.count(name) != 0, "no key \"" + name + "\"");
}
std::vector<const Json*> Json::list() const {
  expect(kind == '[', "a list");
  std::vector<const Json*> items;
  for (const Json& member : members) items.push_back(&member);
  return items;
}
const std::string& Json::text() const {
  expect(kind == '"', "a text");
  return content;
}
Int Json::number(Int least, Int most) const {
  expect(kind == '0' && value >= least && value <= most,
         "a number from " + std::to_string(least) + " to " + std::to_string(most));
  return value;
}

Json parse_json(const std::string& text) { return Parser(text).document(); }

}  // namespace quadrille_check
