// SPDX-License-Identifier: MIT
#include "quadrille/fleet/units.hpp"

#include "numbers.hpp"

namespace quadrille::units {

using fleet::shortest;

std::string to_string(Metres length) { return shortest(length.value()) + " m"; }
std::string to_string(Seconds time) { return shortest(time.value()) + " s"; }
std::string to_string(MetresPerSecond speed) { return shortest(speed.value()) + " m/s"; }
std::string to_string(Hertz rate) { return shortest(rate.value()) + " Hz"; }

}  // namespace quadrille::units
