#include "engine/simulate/turns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

// angles at one time: eleven divisions, one after the other, are waited for once
constexpr std::size_t side_by_side = 16;

template <std::size_t count>
void sines_of_chunk(double const* turns, double* sines) {
  double x[count], square[count], sum[count];
  for (std::size_t i = 0; i < count; ++i) {
    // one turn about zero, then the quarter in which the series is short: sin(pi - x) = sin(x)
    double rest = turns[i] - std::floor(turns[i] + 0.5);
    if (rest > 0.25) rest = 0.5 - rest;
    if (rest < -0.25) rest = -0.5 - rest;
    x[i] = 2.0 * std::numbers::pi * rest;
    square[i] = x[i] * x[i];
    sum[i] = 0.0;
  }
  // x - x^3/3! + ... to x^23: below 1e-20 at a quarter turn
  for (int n = 22; n >= 2; n -= 2) {
    double const factor = n * (n + 1);
    for (std::size_t i = 0; i < count; ++i) sum[i] = -(sum[i] + 1.0) * square[i] / factor;
  }
  for (std::size_t i = 0; i < count; ++i) sines[i] = x[i] + x[i] * sum[i];
}

// by the nearer whole turn, so that a quarter can be added without rounding the angle
double ahead_by_a_quarter(double turns) { return (turns - std::floor(turns + 0.5)) + 0.25; }

}  // namespace

void sines_of_turns(std::span<double const> turns, std::span<double> sines) {
  TORQUESCOPE_EXPECT(turns.size() == sines.size());
  std::size_t first = 0;
  for (; first + side_by_side <= turns.size(); first += side_by_side)
    sines_of_chunk<side_by_side>(turns.data() + first, sines.data() + first);
  if (first == turns.size()) return;
  double rest[side_by_side] = {}, values[side_by_side];
  std::copy(turns.begin() + static_cast<std::ptrdiff_t>(first), turns.end(), rest);
  sines_of_chunk<side_by_side>(rest, values);
  std::copy_n(values, turns.size() - first, sines.begin() + static_cast<std::ptrdiff_t>(first));
}

void quarter_ahead(std::span<double> turns) {
  for (double& angle : turns) angle = ahead_by_a_quarter(angle);
}

double sine_of_turns(double turns) {
  double sine = 0.0;
  sines_of_chunk<1>(&turns, &sine);
  return sine;
}

double cosine_of_turns(double turns) { return sine_of_turns(ahead_by_a_quarter(turns)); }

}  // namespace torquescope
