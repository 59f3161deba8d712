// Why the projection speaks against a trial: a part of effect_search.hpp.

#include <fmt/format.h>

#include <cmath>

#include "engine/search/effect_search.hpp"
#include "engine/search/form_freedom.hpp"
#include "engine/search/reached_bound.hpp"
#include "engine/search/torque_itself.hpp"

namespace torquescope {

// of a change of dry friction over time, of which weighed rows make little
bool EffectSearch::is_large_in_torque_itself(CandidateColumns const& columns, RefinedEffect const& refined) const {
  if (!is_drift_of_friction(*refined.effect)) return false;
  double const whole = excess_in_torque_itself(*selection_.baseline);
  double const gain = gain_in_torque_itself(stage(), columns, {*refined.effect, refined.shape, refined.parameters});
  return whole > 0.0 && gain >= least_share_of_rest * whole;
}

// Twins that follow a measured motion answer the noise of their encoder in another loop than the recording's, half a
// tick late as it does, and are led through reversals by it: what is faint there, or follows the acceleration, may be a
// difference of loops; so may a time of less than a row, however clear it is
bool EffectSearch::may_be_another_loop(Effect const& effect, double gain, Eigen::VectorXd const& parameters) const {
  bool const follows_acceleration = effect.family() == EffectFamily::acceleration;
  if (setting_.loop->source != LoopSource::tracking) return false;
  if (follows_acceleration && effect.parameters().front().unit_revolute == "s")
    return std::abs(parameters[0]) * setting_.recording.rate_hz < 1.0;
  bool const is_of_loop = follows_acceleration || effect.family() == EffectFamily::reversal;
  return is_of_loop && energy_share(stage(), gain) <= smallest_mismatch_share;
}

std::optional<std::string> EffectSearch::refusal(CandidateColumns const& columns, Trial& trial) const {
  auto const* effect = trial.refined.effect;
  double const gain = trial.refined.gain, whole = selection_.whole();
  bool const explains_enough = gain >= least_share_of_rest * remaining_ && gain >= least_share_of_whole * whole;
  bool const is_large = is_large_in_torque_itself(columns, trial.refined);
  if (!explains_enough && !is_large)
    return fmt::format("explains {:.0f} % of what is left (a quarter is asked for)", 100.0 * gain / remaining_);
  if (may_be_another_loop(*effect, gain, trial.refined.parameters))
    return "is too small to be told, where twins have no loop of the recording's, from what another loop does";
  if (!effect->is_plausible(trial.refined.shape, columns.scales())) return "its best shape is none that it could have";
  if (auto const bound =
          fitted_to_bound(columns, *effect, trial.refined.shape, trial.refined.parameters, stage().mismatch()))
    return bound_words(*effect, *bound, columns.joint());
  RegionConsistency const region = region_of(columns, trial.refined);
  trial.region_share = region.share;
  if (!region.holds() && setting_.ablation.region_consistency)
    return fmt::format("takes {:.0f} % of its gain where it acts ({:.0f} % is asked for)", 100.0 * region.share,
                       100.0 * region.asked_for);
  // What happens once cannot be checked on other blocks, and fits whatever twins cannot repeat: more is asked of it.
  // Where the whole mismatch is small it must be certain by itself
  bool const is_once = happens_once(trial);
  if (is_once && is_faint_ && trial.q > faint_q)
    return "happens once, and is too faint to be told from what twins cannot repeat";
  if (is_once && gain < least_share_of_rest * whole && !is_large)
    return fmt::format("happens once, and explains {:.0f} % of the whole (a quarter is asked for)",
                       100.0 * gain / whole);
  if (!is_once && !helps_elsewhere(trial.cv, gain)) return "does not help on blocks it was not fitted to";
  std::vector<double> gains;
  for (auto const& one : selection_.accepted) gains.push_back(one.gain * selection_.energy_unit);
  if (auto const named = form_of_named(gains, trial.refined, stage(), columns))
    return "lies within what another form of " + selection_.accepted[*named].effect->name() + " would explain";
  return std::nullopt;
}

RegionConsistency EffectSearch::region_of(CandidateColumns const& columns, RefinedEffect const& refined) const {
  OrthonormalGroup const group = columns.group(*refined.effect, refined.shape);
  Eigen::VectorXd const torque = group.q * (group.r * refined.parameters);
  auto const& rows = stage().comparison.rows;
  Eigen::VectorXd mismatch = stage().mismatch();
  mismatch -= columns.nuisance() * (columns.nuisance().transpose() * mismatch);
  return region_consistency(torque, mismatch, rows.twins.colwise() - rows.twin_mean);
}

}  // namespace torquescope
