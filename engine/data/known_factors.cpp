#include "engine/data/known_factors.hpp"

#include <cmath>
#include <numbers>

namespace torquescope {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

}  // namespace

std::vector<KnownFactor> const& angle_factors() {
  static std::vector<KnownFactor> const known{{turn / 360.0, "degrees"},
                                              {turn / 400.0, "gon"},
                                              {turn, "turns"},
                                              {1e-3, "thousandths of a rad"},
                                              {-1.0, "the other sign"}};
  return known;
}

std::vector<KnownFactor> const& speed_factors() {
  static std::vector<KnownFactor> const known{{turn / 60.0, "rpm"},
                                              {turn / 360.0, "deg/s"},
                                              {turn, "turns per second"},
                                              {1e-3, "a thousandth of the unit"},
                                              {-1.0, "the wrong sign"}};
  return known;
}

KnownFactor const* nearest_known(std::vector<KnownFactor> const& known, double factor, double tolerance) {
  KnownFactor const* nearest = nullptr;
  double least = tolerance;
  for (auto const& one : known) {
    double const apart = std::fabs(factor / one.factor - 1.0);
    if (apart > least) continue;
    least = apart;
    nearest = &one;
  }
  return nearest;
}

}  // namespace torquescope
