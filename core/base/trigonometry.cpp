// SPDX-License-Identifier: BSD-3-Clause
// Polynomials and constants are those of fdlibm 5.3 (k_sin.c, k_cos.c, e_rem_pio2.c, s_atan.c, e_asin.c, e_acos.c,
// e_log.c):
//   Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved.
//   Developed at SunPro, a Sun Microsystems, Inc. business. Permission to use, copy, modify, and distribute this
//   software is freely granted, provided that this notice is preserved.
// The ways to them are written anew: without branches on random bits, which cost more than polynomials do, and with one
// quotient instead of two for atan2, whose arguments are reduced before they are divided.
// Tried and left: Debian's libsleef, whose Sleef_cinz_... have the same bits everywhere too: three to five times as
// slow one at a time, and one more package.
#include "core/base/trigonometry.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace warren::portable {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// An angle as quarters turned and a rest in about [-pi / 4, pi / 4], the rest in two parts.
struct Reduced {
  double rest;
  double more;
  std::uint64_t quarters;  // modulo 4
};

/// Cody and Waite: pi / 2 in parts of 33 bits, so that products with up to 20 bits are exact, and their tails. The
/// second and third part are wanted only where the first ones leave little: near multiples of pi / 2.
Reduced reduced(double x) {
  constexpr double most = 0x1.921fb5p+20;  // 2^20 quarters
  constexpr double two_over_pi = 6.36619772367581382433e-01;
  constexpr double to_whole = 0x1.8p52;  // added, rounds to whole numbers, which are then the lowest bits
  constexpr double part_1 = 1.57079632673412561417e+00;
  constexpr double tail_1 = 6.07710050650619224932e-11;
  constexpr double part_2 = 6.07710050630396597660e-11;
  constexpr double tail_2 = 2.02226624879595063154e-21;
  constexpr double part_3 = 2.02226624871116645580e-21;
  constexpr double tail_3 = 8.47842766036889956997e-32;
  if (!(std::abs(x) <= most)) x = std::remainder(x, 6.283185307179586476925);
  const double shifted = x * two_over_pi + to_whole;
  const double quarters = shifted - to_whole;
  double from = x - quarters * part_1;
  double tail = quarters * tail_1;
  double rest = from - tail;
  const auto refine = [&](double part, double next_tail) {
    const double before = from;
    const double product = quarters * part;
    from = before - product;
    tail = quarters * next_tail - ((before - from) - product);
    rest = from - tail;
  };
  if (std::abs(rest) < 0x1p-17 * std::abs(x)) {
    refine(part_2, tail_2);
    if (std::abs(rest) < 0x1p-49 * std::abs(x)) refine(part_3, tail_3);
  }
  return {rest, (from - rest) - tail, std::bit_cast<std::uint64_t>(shifted)};
}

double sine_near_zero(double x, double more) {
  const double z = x * x;
  const double w = z * z;
  const double r = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06) +
                   z * w * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10);
  const double v = z * x;
  return x - ((z * (0.5 * more - v * r) - more) - v * -1.66666666666666324348e-01);
}

double cosine_near_zero(double x, double more) {
  const double z = x * x;
  const double w = z * z;
  const double r =
      z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05)) +
      w * w * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
  const double half = 0.5 * z;
  const double one_less = 1.0 - half;
  return one_less + (((1.0 - one_less) - half) + (z * r - x * more));
}

/// x, with its sign changed where bit 1 of `bits` is set.
double signed_by(double x, std::uint64_t bits) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ ((bits & 2U) << 62));
}

/// The angle of (x, y), y >= 0, finite, not both 0: from the nearest of nine directions, to which it has the tangent t.
double angle_above(double y, double x) {
  struct Direction {
    double x, y;
    double hi, lo;  // its angle
  };
  static constexpr Direction directions[] = {
      {1.0, 0.0, 0.0, 0.0},
      {1.0, 0.5, 0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
      {1.0, 1.0, 0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
      {1.0, 1.5, 0x1.f730bd281f69bp-1, 0x1.007887af0cbbdp-56},
      {0.0, 1.0, 0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54},
      {-1.0, 0.0, 0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53},
      {-1.0, 0.5, 0x1.56c6e7397f5aep+1, 0x1.660b64ece6f4bp-53},
      {-1.0, 1.0, 0x1.2d97c7f3321d2p+1, 0x1.a79394c9e8a0ap-54},
      {-1.0, 1.5, 0x1.145385fa3af71p+1, 0x1.fa53523b6428fp-53},
      {0.0, 1.0, 0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54},
  };
  const double right = std::abs(x);
  const int number = 5 * static_cast<int>(std::signbit(x)) + static_cast<int>(y >= 0.4375 * right) +
                     static_cast<int>(y >= 0.6875 * right) + static_cast<int>(y >= 1.1875 * right) +
                     static_cast<int>(y >= 2.4375 * right);
  const Direction& d = directions[number];
  const double t = (d.x * y - d.y * x) / (d.x * x + d.y * y);
  const double z = t * t;
  const double w = z * z;
  const double even = z * (3.33333333333329318027e-01 +
                           w * (1.42857142725034663711e-01 +
                                w * (9.09088713343650656196e-02 +
                                     w * (6.66107313738753120669e-02 +
                                          w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
  const double odd =
      w *
      (-1.99999999998764832476e-01 +
       w * (-1.11111104054623557880e-01 +
            w * (-7.69187620504482999495e-02 + w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
  return d.hi - ((t * (even + odd) - d.lo) - t);
}

/// (asin(x) - x) / x for z = x^2, |x| <= 1/2.
double arcsine_rest(double z) {
  const double p = z * (1.66666666666666657415e-01 +
                        z * (-3.25565818622400915405e-01 +
                             z * (2.01212532134862925881e-01 +
                                  z * (-4.00555345006794114027e-02 +
                                       z * (7.91534994289814532176e-04 + z * 3.47933107596021167570e-05)))));
  const double q =
      1.0 + z * (-2.40339491173441421878e+00 +
                 z * (2.02094576023350569471e+00 + z * (-6.88283971605453293030e-01 + z * 7.70381505559019352791e-02)));
  return p / q;
}

constexpr double half_pi_hi = 1.57079632679489655800e+00;
constexpr double half_pi_lo = 6.12323399573676603587e-17;

/// The root of x; with its lower half taken off, so that its square is exact; and what that left.
struct SplitRoot {
  double whole;
  double hi;
  double lo;
  explicit SplitRoot(double x)
      : whole(std::sqrt(x)),
        hi(std::bit_cast<double>(std::bit_cast<std::uint64_t>(whole) & 0xffffffff00000000U)),
        lo(whole > 0.0 ? (x - hi * hi) / (whole + hi) : 0.0) {}
};

/// A power of two that keeps squares of numbers up to `size` from overflow and underflow.
double square_scale(double size) { return size > 0x1p500 ? 0x1p-600 : size < 0x1p-450 ? 0x1p600 : 1.0; }

}  // namespace

SineAndCosine sin_and_cos(double radians) noexcept {
  const auto [rest, more, quarters] = reduced(radians);
  const double near_zero[] = {sine_near_zero(rest, more), cosine_near_zero(rest, more)};
  return {signed_by(near_zero[quarters & 1U], quarters), signed_by(near_zero[~quarters & 1U], quarters + 1)};
}

double sin(double radians) noexcept { return sin_and_cos(radians).sine; }
double cos(double radians) noexcept { return sin_and_cos(radians).cosine; }

double tan(double radians) noexcept {
  const auto [sine, cosine] = sin_and_cos(radians);
  return sine / cosine;
}

double atan2(double y, double x) noexcept {
  double up = std::abs(y);
  const double size = std::abs(x) > up ? std::abs(x) : up;
  if (!(size >= 0x1p-900 && size <= 0x1p900)) {
    if (std::isnan(x) || std::isnan(y)) return nan;
    if (size == 0.0) {
      x = std::copysign(1.0, x);
    } else if (std::isinf(size)) {
      x = std::copysign(std::isinf(x) ? 1.0 : 0.0, x);
      up = std::isinf(up) ? 1.0 : 0.0;
    } else {
      const double scale = size > 1.0 ? 0x1p-100 : 0x1p100;
      x *= scale;
      up *= scale;
    }
  }
  return std::copysign(angle_above(up, x), y);
}

double atan(double x) noexcept { return atan2(x, 1.0); }

double asin(double x) noexcept {
  const double size = std::abs(x);
  if (!(size <= 1.0)) return nan;
  if (size < 0.5) return x + x * arcsine_rest(x * x);
  const double z = 0.5 * (1.0 - size);  // asin(x) = pi / 2 - 2 asin(sqrt(z))
  const SplitRoot s(z);
  const double rest = 2.0 * s.whole * arcsine_rest(z) - (half_pi_lo - 2.0 * s.lo);
  const double angle = 0.5 * half_pi_hi - (rest - (0.5 * half_pi_hi - 2.0 * s.hi));
  return std::copysign(angle, x);
}

double acos(double x) noexcept {
  const double size = std::abs(x);
  if (!(size <= 1.0)) return nan;
  if (size < 0.5) return half_pi_hi - (x - (half_pi_lo - x * arcsine_rest(x * x)));
  const double z = 0.5 * (1.0 - size);
  const SplitRoot s(z);
  const double rest = arcsine_rest(z) * s.whole;
  return x < 0.0 ? 2.0 * (half_pi_hi - (s.whole + (rest - half_pi_lo))) : 2.0 * (s.hi + (rest + s.lo));
}

double hypot(double x, double y) noexcept { return hypot(x, y, 0.0); }

double hypot(double x, double y, double z) noexcept {
  x = std::abs(x);
  y = std::abs(y);
  z = std::abs(z);
  if (std::isinf(x) || std::isinf(y) || std::isinf(z)) return std::numeric_limits<double>::infinity();
  const double larger = x > y ? x : y;
  const double size = larger > z ? larger : z;
  if (!(size > 0.0)) return x + y + z;
  const double scale = square_scale(size);
  if (scale == 1.0) return std::sqrt(x * x + y * y + z * z);
  return hypot(x * scale, y * scale, z * scale) / scale;
}

double log(double x) noexcept {
  if (x == 0.0) return -std::numeric_limits<double>::infinity();
  if (!(x > 0.0)) return nan;
  if (std::isinf(x)) return x;
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < 0.70710678118654752440) {
    mantissa *= 2.0;
    --exponent;
  }
  const double f = mantissa - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  const double w = z * z;
  const double even = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const double odd =
      z * (6.666666666666735130e-01 +
           w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860510518591e-01)));
  const double half = 0.5 * f * f;
  const double k = exponent;
  return k * 6.93147180369123816490e-01 - ((half - (s * (half + (even + odd)) + k * 1.90821492927058770002e-10)) - f);
}

/// W. Kahan's, of the HP-15C: rounding 1 + x changes its logarithm as much as its distance from 1.
double log1p(double x) noexcept {
  const double sum = 1.0 + x;
  if (sum == 1.0 || std::isinf(sum)) return x;
  return log(sum) * (x / (sum - 1.0));
}

double asinh(double x) noexcept {
  const double size = std::abs(x);
  constexpr double ln2 = 6.93147180559945309417e-01;
  const double value =
      size > 0x1p500 ? log(size) + ln2 : log1p(size + size * (size / (1.0 + std::sqrt(size * size + 1.0))));
  return std::copysign(value, x);
}

}  // namespace warren::portable
