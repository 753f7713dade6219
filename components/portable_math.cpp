#include "components/portable_math.hpp"

#include <sleef.h>

#include <cmath>

// In SLEEF's names "cinz" are the reproducible functions that do not use a fused multiply-add, "u10" is an error of at
// most 1.0 units in the last place, "purec" is plain C, "d1" one number and "d4" four.
namespace tamp::portable
{

double exp(double x)
{
  return Sleef_cinz_expd1_u10purec(x);
}
long double exp(long double x)
{
  // ln 2 in two parts, of which the first has few enough bits for its multiples to be exact.
  constexpr long double ln2_first = 0x1.62e42fefp-1L, ln2_rest = 0x0.a39ef35793c7673007ep-33L;
  const long double n = std::rint(x / (ln2_first + ln2_rest)), rest = x - n * ln2_first - n * ln2_rest;
  long double sum = 1;
  for (int k = 18; k > 0; --k) sum = 1 + rest / static_cast<long double>(k) * sum;
  return std::ldexp(sum, static_cast<int>(n));
}
double expm1(double x)
{
  return Sleef_cinz_expm1d1_u10purec(x);
}
double log(double x)
{
  return Sleef_cinz_logd1_u10purec(x);
}
double log1p(double x)
{
  return Sleef_cinz_log1pd1_u10purec(x);
}
double log2(double x)
{
  return Sleef_cinz_log2d1_u10purec(x);
}
double pow(double base, double exponent)
{
  return Sleef_cinz_powd1_u10purec(base, exponent);
}
double hypot(double x, double y)
{
  return Sleef_cinz_hypotd1_u05purec(x, y);
}
double sin(double angle)
{
  return Sleef_cinz_sind1_u10purec(angle);
}
double cos(double angle)
{
  return Sleef_cinz_cosd1_u10purec(angle);
}
double asin(double x)
{
  return Sleef_cinz_asind1_u10purec(x);
}
double acos(double x)
{
  return Sleef_cinz_acosd1_u10purec(x);
}
double atan2(double y, double x)
{
  return Sleef_cinz_atan2d1_u10purec(y, x);
}
double tanh(double x)
{
  return Sleef_cinz_tanhd1_u10purec(x);
}

// SLEEF's function of as many numbers as there are lanes.
#if defined(__AVX512F__)
#  define TAMP_SLEEF(function) Sleef_cinz_##function##d8_u10avx512fnofma
using Register = __m512d;
#elif defined(__AVX__)
#  define TAMP_SLEEF(function) Sleef_cinz_##function##d4_u10avx
using Register = __m256d;
#elif defined(__SSE2__)
#  define TAMP_SLEEF(function) Sleef_cinz_##function##d2_u10sse2
using Register = __m128d;
#else
#  define TAMP_SLEEF(function) Sleef_cinz_##function##d1_u10purec
using Register = double;
#endif

template <auto function, class... Arguments>
static Lanes of_lanes(const Arguments&... x)
{
  if constexpr (sizeof(Register) == sizeof(double)) {
    return each_lane([&](std::size_t l) { return function(x[l]...); });
  } else {
    return Lanes(function(static_cast<Register>(x)...));
  }
}

Lanes exp(const Lanes& x)
{
  return of_lanes<TAMP_SLEEF(exp)>(x);
}
Lanes expm1(const Lanes& x)
{
  return of_lanes<TAMP_SLEEF(expm1)>(x);
}
Lanes log(const Lanes& x)
{
  return of_lanes<TAMP_SLEEF(log)>(x);
}
Lanes log1p(const Lanes& x)
{
  return of_lanes<TAMP_SLEEF(log1p)>(x);
}
Lanes pow(const Lanes& base, const Lanes& exponent)
{
  return of_lanes<TAMP_SLEEF(pow)>(base, exponent);
}
Lanes cos(const Lanes& angle)
{
  return of_lanes<TAMP_SLEEF(cos)>(angle);
}
Lanes acos(const Lanes& x)
{
  return of_lanes<TAMP_SLEEF(acos)>(x);
}
Lanes tanh(const Lanes& x)
{
  return of_lanes<TAMP_SLEEF(tanh)>(x);
}

}  // namespace tamp::portable
