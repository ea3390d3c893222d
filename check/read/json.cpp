// SPDX-License-Identifier: MIT
#include "read/json.hpp"

#include <algorithm>
#include <charconv>

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
    const char first = next();
    json.kind = is_digit(first) || first == '-' ? '0' : first;
    if (json.kind == '"') {
      json.content = text();
    } else if (json.kind == '{' || json.kind == '[') {
      read_members(json, depth);
    } else if (text_.compare(at_, 4, "true") == 0 || text_.compare(at_, 5, "false") == 0) {
      at_ += first == 't' ? 4 : 5;
    } else {
      expect(json.kind == '0', "an object, a list, a text, a number, true or false");
      read_number(json);
    }
    return json;
  }

  void read_number(Json& json) {
    const std::size_t begin = at_, end = text_.find_first_not_of("0123456789+-.eE", at_);
    const std::string number = text_.substr(begin, end - begin);
    at_ += number.size();
    const auto digits = std::min(number.find_first_not_of("0123456789"), number.size());
    const std::size_t sign = number[0] == '-' ? 1 : 0;
    const auto is_at = [&](std::size_t k, auto what) {
      return k < number.size() && what(number[k]);
    };
    expect(is_at(sign, is_digit) && !(number[sign] == '0' && is_at(sign + 1, is_digit)),
           "a number, without leading zeros");
    const auto point = number.find('.');
    expect(point == std::string::npos || is_at(point + 1, is_digit), "digits after the point");
    const auto [rest, error] =
        std::from_chars(number.data(), number.data() + number.size(), json.real);
    expect(error == std::errc() && rest == number.data() + number.size(), "a number");
    if (digits == number.size() && json.real < static_cast<double>(kEndOfTime))
      json.value = static_cast<Int>(json.real);
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
  for (const std::string& name : names)
    expect(keys.count(name) != 0, "no key \"" + name + "\", for which there is no rule");
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
bool Json::is_true() const {
  expect(kind == 't' || kind == 'f', "true or false");
  return kind == 't';
}
Int Json::number(Int least, Int most) const {
  expect(kind == '0' && value && *value >= least && *value <= most,
         "a natural number from " + std::to_string(least) + " to " + std::to_string(most));
  return *value;
}
double Json::any_number() const {
  expect(kind == '0', "a number");
  return real;
}

Json parse_json(const std::string& text) { return Parser(text).document(); }

}  // namespace quadrille_check
