#include "engine/fit/optim/movement_share.hpp"

#include <algorithm>
#include <numbers>

#include "engine/base/portable_math.hpp"

namespace torquescope {

namespace {

constexpr double least_movement = 0.01;
constexpr std::size_t no_centroid = 101;

// decades above the least movement, 0 .. 2
double decades(double movement) {
  return portable_log(std::clamp(movement / least_movement, 1.0, 100.0)) / std::numbers::ln10;
}

FuzzyVariable movement_variable(char const* name) { return {name, 2.0, 0.5, {0.0, 1.0, 2.0}}; }

}  // namespace

MovementShare::MovementShare()
    : system_(movement_variable("PC"), movement_variable("FC"), {"share", 1.0, 0.25, {0.1, 0.5, 0.9}},
              Defuzzification::weighted_average, no_centroid) {}

double MovementShare::operator()(Movement const& of_population) const {
  return system_(decades(of_population.PC), decades(of_population.FC));
}

}  // namespace torquescope
