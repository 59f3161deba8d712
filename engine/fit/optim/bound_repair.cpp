#include "engine/fit/optim/bound_repair.hpp"

#include <algorithm>
#include <cmath>

namespace torquescope {

std::vector<std::string> const& bound_repair_words() {
  static std::vector<std::string> const words{"midpoint", "clip", "reflect", "random"};
  return words;
}

namespace {

double clipped(double x, double lower, double upper) { return x > upper ? upper : x >= lower ? x : lower; }

}  // namespace

double reflected(double x, double lower, double upper) {
  if (!std::isfinite(x)) return clipped(x, lower, upper);
  // the mirrored path repeats every two widths: up, then down
  double const width = upper - lower;
  double const phase = std::fmod(std::fabs(x - lower), 2.0 * width);
  return clipped(lower + (phase <= width ? phase : 2.0 * width - phase), lower, upper);
}

double repaired(BoundRepair repair, double x, double lower, double upper, double target, RandomStream& random) {
  switch (repair) {
    case BoundRepair::midpoint:
      return 0.5 * target + 0.5 * (x > upper ? upper : lower);
    case BoundRepair::clip:
      return clipped(x, lower, upper);
    case BoundRepair::reflect:
      return reflected(x, lower, upper);
    case BoundRepair::random:
      break;
  }
  return std::min(random.uniform(lower, upper), upper);
}

}  // namespace torquescope
