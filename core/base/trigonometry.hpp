// SPDX-License-Identifier: BSD-3-Clause
// The functions of <cmath> whose last bit is the library's affair, each from additions, products, quotients and roots
// alone, which every processor rounds alike: so answers are the same bytes on x86-64 with and without FMA, on arm64 and
// with any compiler. (glibc takes other sums where a processor has FMA: sin, cos, atan2 and their kin then differ in
// the last bit for one argument of some hundreds.) Everywhere else in the library <cmath> gives only what is exact:
// roots, fma, remainder, fmod, floor and their kin; check_layers.cmake says so.
//
// Errors, in units of the last place: sin, cos, asin, acos and log below 1, atan, atan2 and hypot of two below 1.5,
// tan, hypot of three, log1p and asinh below 4 (tests/core/base/trigonometry_test.cpp). All are odd or even as they
// should be and give what <cmath> gives at zeros, infinities and NaN. Cost: less than glibc's but for log (functions in
// bench/trigonometry_bench.cpp).
#pragma once

namespace warren::portable {

struct SineAndCosine {
  double sine;
  double cosine;
};

/// Sine and cosine for little more than one of them costs. Radians; beyond 1.6 million the angle is first taken modulo
/// the double nearest to 2 pi: still the same bits everywhere, but off by 4e-17 of the angle.
SineAndCosine sin_and_cos(double radians) noexcept;
double sin(double radians) noexcept;
double cos(double radians) noexcept;
double tan(double radians) noexcept;

/// The angle of (x, y) in [-pi, pi].
double atan2(double y, double x) noexcept;
double atan(double x) noexcept;
/// NaN outside [-1, 1].
double asin(double x) noexcept;
double acos(double x) noexcept;

/// Lengths, without overflow or underflow on the way.
double hypot(double x, double y) noexcept;
double hypot(double x, double y, double z) noexcept;

/// -inf at 0, NaN below.
double log(double x) noexcept;
/// log(1 + x), and the inverse of the hyperbolic sine: to some units in the last place near 0, too.
double log1p(double x) noexcept;
double asinh(double x) noexcept;

}  // namespace warren::portable
