// SPDX-License-Identifier: MIT
#include "timed/meeting.hpp"

#include <algorithm>
#include <cstddef>

namespace quadrille_check {
namespace {

__extension__ using Word = unsigned __int128;

/// Integers of 512 bits, negative ones as complements.
class Wide {
 public:
  Wide(Int value) : words_{static_cast<std::uint64_t>(value)} {  // NOLINT: a number will do
    if (value < 0) std::fill(words_.begin() + 1, words_.end(), ~std::uint64_t{0});
  }
  friend Wide operator+(const Wide& a, const Wide& b) {
    Wide sum(0);
    Word carry = 0;
    for (std::size_t k = 0; k < kWords; ++k) {
      carry += static_cast<Word>(a.words_[k]) + b.words_[k];
      sum.words_[k] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return sum;
  }
  friend Wide operator-(const Wide& a, const Wide& b) {
    Wide opposite(0);
    for (std::size_t k = 0; k < kWords; ++k) opposite.words_[k] = ~b.words_[k];
    return a + opposite + Wide(1);
  }
  friend Wide operator*(const Wide& a, const Wide& b) {
    Wide product(0);
    for (std::size_t i = 0; i < kWords; ++i) {
      if (a.words_[i] == 0) continue;
      Word carry = 0;
      for (std::size_t j = 0; i + j < kWords; ++j) {
        carry += static_cast<Word>(a.words_[i]) * b.words_[j] + product.words_[i + j];
        product.words_[i + j] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
      }
    }
    return product;
  }
  friend bool operator<(const Wide& a, const Wide& b) { return (a - b).is_negative(); }

 private:
  static constexpr std::size_t kWords = 8;
  [[nodiscard]] bool is_negative() const { return words_.back() >> 63 != 0; }
  std::array<std::uint64_t, kWords> words_{};
};

}  // namespace

// Times d * e, where d and e are how long the two last: at u after the first common moment the
// centres differ by P + V u, and the interiors meet if that is less than R somewhere. The square is
// least at an end, or at u = -(P V) / (V V), where it is (P P) - (P V)^2 / (V V).
bool do_meet(const Motion& a, const Motion& b) {
  const Int begin = std::max(a.begin, b.begin), end = std::min(a.end, b.end);
  if (begin > end) return false;
  const auto lasts = [](const Motion& m) { return m.from == m.to ? 1 : m.end - m.begin; };
  const Wide d = lasts(a), e = lasts(b);
  const auto moved = [&](const Motion& m, std::size_t k) {
    return m.from == m.to ? Wide(0) : Wide(m.to[k] - m.from[k]) * Wide(begin - m.begin);
  };
  Wide pp = 0, pv = 0, vv = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Wide p =
        (Wide(a.from[k]) * d + moved(a, k)) * e - (Wide(b.from[k]) * e + moved(b, k)) * d;
    const Wide v = Wide(a.to[k] - a.from[k]) * e - Wide(b.to[k] - b.from[k]) * d;
    pp = pp + p * p;
    pv = pv + p * v;
    vv = vv + v * v;
  }
  const Wide reach = Wide(a.radius + b.radius) * d * e, rr = reach * reach, u = end - begin;
  if (pp < rr || pp + pv * u * 2 + vv * u * u < rr) return true;
  const bool is_between = pv < Wide(0) && Wide(0) - pv < vv * u;
  return is_between && pp * vv - pv * pv < rr * vv;
}

}  // namespace quadrille_check
