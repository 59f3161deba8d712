#include "engine/infer/search/selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace torquescope {

double Selection::whole() const { return std::max(first_excess * energy_unit, std::numeric_limits<double>::min()); }

bool Selection::has_accepted(Effect const* effect) const {
  return std::any_of(accepted.begin(), accepted.end(), [&](auto const& one) { return one.effect == effect; });
}

double energy_about_true_mean(ModelStage const& stage) {
  return stage.mismatch().squaredNorm() - stage.energy.noise / static_cast<double>(stage.comparison.rows.n_twins() + 1);
}

double energy_share(ModelStage const& stage, double energy) {
  double const whole = stage.comparison.rows.torque.squaredNorm();
  return whole > 0.0 ? std::sqrt(std::max(0.0, energy) / whole) : 0.0;
}

double mismatch_share(ModelStage const& stage) { return energy_share(stage, stage.energy.excess); }

}  // namespace torquescope
