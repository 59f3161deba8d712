#include "engine/search/buildup_trial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/search/own_motion.hpp"

namespace torquescope {
namespace {

// Of what is left beside the nuisance, by projection
constexpr double enough_to_try = 0.25;

// n x 5: what a smeared sign leaves of a sharp one
Eigen::MatrixXd smeared_signs(Motion const& motion, JointScales const& scales) {
  constexpr int count = 5;
  constexpr double slowest = 1.0 / 2000.0, factor = 3.0;
  double const peak = motion.dq.cwiseAbs().maxCoeff();
  Eigen::MatrixXd signals(motion.dq.size(), count);
  for (int k = 0; k < count; ++k) {
    double const speed = peak * slowest * std::pow(factor, k);
    for (Eigen::Index i = 0; i < motion.dq.size(); ++i)
      signals(i, k) = scales.friction_sign()(motion.dq[i]) * (std::tanh(std::abs(motion.dq[i]) / speed) - 1.0);
  }
  return signals;
}

// what is left of signals beside a basis
Eigen::MatrixXd beside(Eigen::MatrixXd const& basis, Eigen::MatrixXd const& signals) {
  return signals - basis * (basis.transpose() * signals);
}

// energy of the signal beyond noise, beside the nuisance
double left_beside(Eigen::MatrixXd const& nuisance, Eigen::VectorXd const& signal, MismatchRows const& rows) {
  auto const m = static_cast<double>(rows.n_twins());
  double const noise = beside(nuisance, rows.twins.colwise() - rows.twin_mean).squaredNorm() / (m - 1.0);
  return beside(nuisance, signal).squaredNorm() - noise * (1.0 + 1.0 / m);
}

// Nested loops have parameters enough for any law of building up, and no bound on what they add up to: where the
// simpler law explains half as much it is the one that is modelled, and the other is asked as its rival
Trial simplest_of(std::vector<Trial> trials) {
  constexpr double half = 0.5;
  auto const most = std::max_element(trials.begin(), trials.end(),
                                     [](auto const& a, auto const& b) { return a.refined.gain < b.refined.gain; });
  Trial* best = &*most;
  for (auto& trial : trials)
    if (trial.refined.effect->n_linear() < best->refined.effect->n_linear() &&
        trial.refined.gain >= half * most->refined.gain)
      best = &trial;
  return std::move(*best);
}

// one motion, and what is to be explained along it
struct Along {
  CandidateColumns columns;
  DrivenBy driven_by;
  Eigen::VectorXd signal;

  std::optional<RefinedEffect> refined(EffectScan const& scan, BuildupLook const& look) const {
    if (driven_by == DrivenBy::recording)
      return refine_on_own_motion(columns, scan, signal, {look.shape_optimiser, look.seed}, look.threads);
    return refine_shape(columns, scan, signal, shape_search(look.shape_optimiser, look.seed), look.threads);
  }
  // at the shape of the scan
  double gain(EffectScan const& scan) const {
    if (driven_by == DrivenBy::twin) return scan.gain;
    OrthonormalGroup const group = columns.group(*scan.effect, scan.shape);
    return bounded_gain(group, group.q.transpose() * signal).gain;
  }
};

}  // namespace

bool is_buildup(Effect const& effect) {
  static std::vector<EffectFamily> const families{EffectFamily::reversal};
  static std::vector<SignatureAxis> const axes{SignatureAxis::since_velocity_reversal, SignatureAxis::velocity};
  return effect.is_dry_friction() && effect.families() == families && effect.signature() == axes;
}

CandidateColumns buildup_columns(BuildupLook const& look, DrivenBy driven_by) {
  auto const& comparison = look.rows.comparison;
  CandidateColumns columns(*look.rows.pipeline, comparison, look.reference, look.parameters, CandidateColumns::none,
                           driven_by);
  columns.add_nuisance(smeared_signs(
      driven_by == DrivenBy::recording ? comparison.recording.motion : comparison.common.motion, columns.scales()));
  return columns;
}

std::optional<Trial> buildup_trial(BuildupLook const& look, DrivenBy driven_by, std::vector<EffectScan> const& scans,
                                   std::vector<double> const& q, std::int64_t& evaluations) {
  Along const along{buildup_columns(look, driven_by), driven_by,
                    driven_by == DrivenBy::recording ? look.rows.comparison.rows.residual : look.rows.mismatch()};
  std::vector<Trial> trials;
  double most_of_others = 0.0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    auto const& scan = scans[i];
    if (!is_buildup(*scan.effect)) {
      if (scan.is_testable) most_of_others = std::max(most_of_others, along.gain(scan));
      continue;
    }
    if (!scan.is_testable || q[i] > look.q || !(scan.gain > 0.0)) continue;
    auto refined = along.refined(scan, look);
    if (!refined) continue;
    evaluations += refined->evaluations;
    Trial trial{scan, q[i], std::move(*refined), driven_by};
    trial.cv = blocked_gain(along.signal, along.columns.nuisance(),
                            along.columns.columns(*scan.effect, trial.refined.shape), guard_rows(*look.rows.pipeline));
    trials.push_back(std::move(trial));
  }
  if (trials.empty()) return std::nullopt;
  Trial best = simplest_of(std::move(trials));
  double const gain = best.refined.gain;
  bool const holds =
      gain > most_of_others &&
      gain > enough_to_try * left_beside(along.columns.nuisance(), along.signal, look.rows.comparison.rows) &&
      best.refined.effect->is_plausible(best.refined.shape, along.columns.scales()) && helps_elsewhere(best.cv, gain);
  return holds ? std::optional(std::move(best)) : std::nullopt;
}

}  // namespace torquescope
