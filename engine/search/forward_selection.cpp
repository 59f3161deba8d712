#include "engine/search/forward_selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/search/backward_selection.hpp"
#include "engine/search/rival_lines.hpp"
#include "engine/statistics/multiple_testing.hpp"

namespace torquescope {

double Selection::whole() const { return std::max(first_excess * energy_unit, std::numeric_limits<double>::min()); }

bool Selection::has_accepted(Effect const* effect) const {
  return std::any_of(accepted.begin(), accepted.end(), [&](auto const& one) { return one.effect == effect; });
}

std::vector<double> q_of(std::vector<EffectScan> const& scans) {
  std::vector<double> p;
  std::vector<std::string> family;
  for (auto const& scan : scans) {
    p.push_back(scan.p);
    family.push_back(word(scan.effect->family()));
  }
  return hierarchical_q(p, family);
}

double energy_about_true_mean(ModelStage const& stage) {
  return stage.mismatch().squaredNorm() - stage.energy.noise / static_cast<double>(stage.comparison.rows.n_twins() + 1);
}

double energy_share(ModelStage const& stage, double energy) {
  double const whole = stage.comparison.rows.torque.squaredNorm();
  return whole > 0.0 ? std::sqrt(std::max(0.0, energy) / whole) : 0.0;
}

double mismatch_share(ModelStage const& stage) { return energy_share(stage, stage.energy.excess); }

bool is_significant(ModelStage const& stage) {
  return stage.energy.z > smallest_omnibus_z && mismatch_share(stage) > smallest_mismatch_share;
}

Selection select_effects(StageSetting const& setting, SelectionOptions const& options, StageSink const& progress) {
  EffectSearch const end = best_line(EffectSearch(setting, options, progress));
  Selection selection = end.selection();
  if (selection.accepted.size() > 1) revise_selection(end.setting(), options, selection);
  return selection;
}

}  // namespace torquescope
