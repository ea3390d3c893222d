// SPDX-License-Identifier: MIT
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace quadrille::geometry::exact {

// The largest numbers: positions are scaled by the two durations, 2^43 * 2^80, so that dot products
// of two differences of such vectors are below 2^250, in the plane and in space. A squared cross
// product is below 2^500, a fraction times another's denominator below 2^760.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    1024, 1024, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;

// Not negative denominator.
struct Fraction {
  Integer numerator;
  Integer denominator;
};
inline bool operator<(const Fraction& p, const Fraction& q) {
  return p.numerator * q.denominator < q.numerator * p.denominator;
}
inline int compare(const Fraction& p, const Fraction& q) { return p < q ? -1 : q < p ? 1 : 0; }

}  // namespace quadrille::geometry::exact
