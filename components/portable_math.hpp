#pragma once

#include "components/lanes.hpp"

/// Elementary functions whose bits do not depend on the processor. The C library's own do: it chooses among several
/// versions of exp, pow, sin and the like when a program starts, with fused multiply-add where there is one. These are
/// SLEEF's reproducible ones, without it. Errors are below 1 unit in the last place. Angles in radians.
///
/// The square root is exact everywhere, and so std::sqrt will do; a test sees to it that nothing else of the C
/// library's is called.
namespace tamp::portable
{

double exp(double x);
/// The exponential of a finite number, within 2 units in the last place of 64 bits. The C library's is the processor's
/// own, and those of two makers differ.
long double exp(long double x);
double expm1(double x);
double log(double x);
double log1p(double x);
double log2(double x);
double pow(double base, double exponent);
double hypot(double x, double y);
double sin(double angle);
double cos(double angle);
double asin(double x);
double acos(double x);
double atan2(double y, double x);
double tanh(double x);

/// The functions of many numbers at once: each lane has the bits that the function of one number gives. Angles to 15,
/// where SLEEF begins to choose by the largest of them how it takes whole turns off.
Lanes exp(const Lanes& x);
Lanes expm1(const Lanes& x);
Lanes log(const Lanes& x);
Lanes log1p(const Lanes& x);
Lanes pow(const Lanes& base, const Lanes& exponent);
Lanes cos(const Lanes& angle);
Lanes acos(const Lanes& x);
Lanes tanh(const Lanes& x);

}  // namespace tamp::portable
