#include "engine/optim/bound_repair.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/base/contract.hpp"

namespace torquescope {

std::vector<std::string> const& bound_repair_words() {
  static std::vector<std::string> const words{"midpoint", "clip", "reflect", "random"};
  return words;
}

namespace {

double clipped(double x, double lower, double upper) { return x > upper ? upper : x >= lower ? x : lower; }

double reflected(double x, double lower, double upper) {
  if (!std::isfinite(x)) return clipped(x, lower, upper);
  // the mirrored path repeats every two widths: up, then down
  double const width = upper - lower;
  double const phase = std::fmod(std::fabs(x - lower), 2.0 * width);
  return clipped(lower + (phase <= width ? phase : 2.0 * width - phase), lower, upper);
}

}  // namespace

void repair_bounds(BoundRepair repair, Bounds const& bounds, std::span<double const> target, RandomStream& random,
                   std::span<double> trial) {
  TORQUESCOPE_EXPECT(trial.size() == bounds.dimension() && target.size() == trial.size());
  for (std::size_t j = 0; j < trial.size(); ++j) {
    double const lower = bounds.lower[j];
    double const upper = bounds.upper[j];
    if (trial[j] >= lower && trial[j] <= upper) continue;
    switch (repair) {
      case BoundRepair::midpoint:
        trial[j] = 0.5 * target[j] + 0.5 * (trial[j] > upper ? upper : lower);
        break;
      case BoundRepair::clip:
        trial[j] = clipped(trial[j], lower, upper);
        break;
      case BoundRepair::reflect:
        trial[j] = reflected(trial[j], lower, upper);
        break;
      case BoundRepair::random:
        trial[j] = std::min(random.uniform(lower, upper), upper);
        break;
    }
    TORQUESCOPE_ENSURE(trial[j] >= lower && trial[j] <= upper);
  }
}

}  // namespace torquescope
