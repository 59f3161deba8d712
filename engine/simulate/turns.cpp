#include "engine/simulate/turns.hpp"

#include <cmath>
#include <numbers>

namespace torquescope {

double sine_of_turns(double turns) {
  // one turn about zero, then the quarter in which the series is short: sin(pi - x) = sin(x)
  double rest = turns - std::floor(turns + 0.5);
  if (rest > 0.25) rest = 0.5 - rest;
  if (rest < -0.25) rest = -0.5 - rest;

  // x - x^3/3! + ... to x^23: below 1e-20 at a quarter turn
  double const x = 2.0 * std::numbers::pi * rest;
  double const square = x * x;
  double sum = 0.0;
  for (int n = 22; n >= 2; n -= 2) sum = -(sum + 1.0) * square / (n * (n + 1));
  return x + x * sum;
}

double cosine_of_turns(double turns) {
  // by the nearer whole turn, so that a quarter can be added without rounding the angle
  return sine_of_turns((turns - std::floor(turns + 0.5)) + 0.25);
}

}  // namespace torquescope
