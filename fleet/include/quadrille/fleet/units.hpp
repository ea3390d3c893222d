// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <numbers>
#include <string>

#include "quadrille/core/export.hpp"

// Metres, seconds, angles and what follows from them, as types: 0.35_m, 0.8_mps, 50_ms, 20_Hz,
// 90_deg. A plain number becomes one of them by an explicit `Metres(number)` only, and the other
// way round by `value()` only.

QUADRILLE_API_BEGIN

namespace quadrille::units {

/// A real number of one unit.
template <class Unit>
class Measure {
 public:
  constexpr Measure() = default;  ///< Zero.
  constexpr explicit Measure(double value) noexcept : value_(value) {}

  /// In metres, seconds, metres per second, hertz, radians or radians per second.
  [[nodiscard]] constexpr double value() const noexcept { return value_; }

  friend constexpr auto operator<=>(Measure, Measure) = default;

  [[nodiscard]] constexpr Measure operator-() const noexcept { return Measure(-value_); }
  [[nodiscard]] friend constexpr Measure operator+(Measure a, Measure b) noexcept {
    return Measure(a.value_ + b.value_);
  }
  [[nodiscard]] friend constexpr Measure operator-(Measure a, Measure b) noexcept {
    return Measure(a.value_ - b.value_);
  }
  constexpr Measure& operator+=(Measure other) noexcept {
    value_ += other.value_;
    return *this;
  }
  constexpr Measure& operator-=(Measure other) noexcept {
    value_ -= other.value_;
    return *this;
  }
  [[nodiscard]] friend constexpr Measure operator*(Measure measure, double factor) noexcept {
    return Measure(measure.value_ * factor);
  }
  [[nodiscard]] friend constexpr Measure operator*(double factor, Measure measure) noexcept {
    return Measure(factor * measure.value_);
  }
  [[nodiscard]] friend constexpr Measure operator/(Measure measure, double divisor) noexcept {
    return Measure(measure.value_ / divisor);
  }
  /// How often the second goes into the first.
  [[nodiscard]] friend constexpr double operator/(Measure a, Measure b) noexcept {
    return a.value_ / b.value_;
  }

 private:
  double value_ = 0;
};

using Metres = Measure<struct MetreUnit>;
using Seconds = Measure<struct SecondUnit>;
using MetresPerSecond = Measure<struct MetrePerSecondUnit>;
using Hertz = Measure<struct HertzUnit>;
using Radians = Measure<struct RadianUnit>;  ///< Counter-clockwise where x points right and y up.
using RadiansPerSecond = Measure<struct RadianPerSecondUnit>;

/// A number of degrees.
[[nodiscard]] constexpr Radians degrees(double value) noexcept {
  return Radians(value * std::numbers::pi / 180);
}
[[nodiscard]] constexpr double in_degrees(Radians angle) noexcept {
  return angle.value() * 180 / std::numbers::pi;
}
[[nodiscard]] constexpr RadiansPerSecond operator/(Radians angle, Seconds time) noexcept {
  return RadiansPerSecond(angle.value() / time.value());
}
[[nodiscard]] constexpr Seconds operator/(Radians angle, RadiansPerSecond rate) noexcept {
  return Seconds(angle.value() / rate.value());
}

[[nodiscard]] constexpr MetresPerSecond operator/(Metres way, Seconds time) noexcept {
  return MetresPerSecond(way.value() / time.value());
}
[[nodiscard]] constexpr Seconds operator/(Metres way, MetresPerSecond speed) noexcept {
  return Seconds(way.value() / speed.value());
}
[[nodiscard]] constexpr Metres operator*(MetresPerSecond speed, Seconds time) noexcept {
  return Metres(speed.value() * time.value());
}
[[nodiscard]] constexpr Metres operator*(Seconds time, MetresPerSecond speed) noexcept {
  return speed * time;
}

/// The shortest decimal number and the unit: "0.35 m", "3.2 s", "0.8 m/s", "20 Hz".
[[nodiscard]] std::string to_string(Metres length);
[[nodiscard]] std::string to_string(Seconds time);
[[nodiscard]] std::string to_string(MetresPerSecond speed);
[[nodiscard]] std::string to_string(Hertz rate);
/// In degrees, rounded to a millionth: "90 deg", "22.5 deg/s".
[[nodiscard]] std::string to_string(Radians angle);
[[nodiscard]] std::string to_string(RadiansPerSecond rate);

// The factors are divisions where the number would not be exact otherwise: 350_mm is 0.35_m.

[[nodiscard]] constexpr Metres operator""_m(long double value) noexcept {
  return Metres(static_cast<double>(value));
}
[[nodiscard]] constexpr Metres operator""_m(unsigned long long value) noexcept {
  return Metres(static_cast<double>(value));
}
[[nodiscard]] constexpr Metres operator""_cm(long double value) noexcept {
  return Metres(static_cast<double>(value / 100));
}
[[nodiscard]] constexpr Metres operator""_cm(unsigned long long value) noexcept {
  return Metres(static_cast<double>(value) / 100);
}
[[nodiscard]] constexpr Metres operator""_mm(long double value) noexcept {
  return Metres(static_cast<double>(value / 1000));
}
[[nodiscard]] constexpr Metres operator""_mm(unsigned long long value) noexcept {
  return Metres(static_cast<double>(value) / 1000);
}

[[nodiscard]] constexpr Seconds operator""_s(long double value) noexcept {
  return Seconds(static_cast<double>(value));
}
[[nodiscard]] constexpr Seconds operator""_s(unsigned long long value) noexcept {
  return Seconds(static_cast<double>(value));
}
[[nodiscard]] constexpr Seconds operator""_ms(long double value) noexcept {
  return Seconds(static_cast<double>(value / 1000));
}
[[nodiscard]] constexpr Seconds operator""_ms(unsigned long long value) noexcept {
  return Seconds(static_cast<double>(value) / 1000);
}

[[nodiscard]] constexpr MetresPerSecond operator""_mps(long double value) noexcept {
  return MetresPerSecond(static_cast<double>(value));
}
[[nodiscard]] constexpr MetresPerSecond operator""_mps(unsigned long long value) noexcept {
  return MetresPerSecond(static_cast<double>(value));
}

[[nodiscard]] constexpr Hertz operator""_Hz(long double value) noexcept {
  return Hertz(static_cast<double>(value));
}
[[nodiscard]] constexpr Hertz operator""_Hz(unsigned long long value) noexcept {
  return Hertz(static_cast<double>(value));
}

[[nodiscard]] constexpr Radians operator""_deg(long double value) noexcept {
  return degrees(static_cast<double>(value));
}
[[nodiscard]] constexpr Radians operator""_deg(unsigned long long value) noexcept {
  return degrees(static_cast<double>(value));
}
[[nodiscard]] constexpr Radians operator""_rad(long double value) noexcept {
  return Radians(static_cast<double>(value));
}
[[nodiscard]] constexpr Radians operator""_rad(unsigned long long value) noexcept {
  return Radians(static_cast<double>(value));
}

[[nodiscard]] constexpr RadiansPerSecond operator""_degps(long double value) noexcept {
  return degrees(static_cast<double>(value)) / Seconds(1);
}
[[nodiscard]] constexpr RadiansPerSecond operator""_degps(unsigned long long value) noexcept {
  return degrees(static_cast<double>(value)) / Seconds(1);
}
[[nodiscard]] constexpr RadiansPerSecond operator""_radps(long double value) noexcept {
  return RadiansPerSecond(static_cast<double>(value));
}
[[nodiscard]] constexpr RadiansPerSecond operator""_radps(unsigned long long value) noexcept {
  return RadiansPerSecond(static_cast<double>(value));
}

}  // namespace quadrille::units

QUADRILLE_API_END
