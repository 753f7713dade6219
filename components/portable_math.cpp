#include "components/portable_math.hpp"

#include <sleef.h>

// In SLEEF's names "cinz" are the reproducible functions that do not use a fused multiply-add, "u10" is an error of at
// most 1.0 units in the last place, "purec" is plain C.
namespace tamp::portable
{

double exp(double x)
{
  return Sleef_cinz_expd1_u10purec(x);
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

}  // namespace tamp::portable
