#include "engine/diagnose/form_freedom.hpp"

#include "engine/diagnose/hat_functions.hpp"
#include "engine/diagnose/map_axes.hpp"

namespace torquescope {
namespace {

constexpr double what_a_form_may_cost = 0.1;
constexpr double most_beside_it = 0.5;
constexpr Eigen::Index n_knots_of_form = 12;

// at the full rate
Eigen::MatrixXd forms_of(Effect const& effect, ModelStage const& stage) {
  MotionAxes const axes = motion_axes(stage.model(), stage.comparison.rows.motion, stage.parameters());
  SignatureAxis const axis = effect.signature().front();
  Eigen::VectorXd const at = values_on(axis, axes);
  // of the speed: a function of the velocity would be of either parity
  Eigen::MatrixXd const any = hats(axis == SignatureAxis::velocity ? at.cwiseAbs() : at, n_knots_of_form);
  Eigen::MatrixXd along_motion = any;
  along_motion.array().colwise() *= axes.dq.array().sign();
  if (effect.parity() == Parity::even) return any;
  if (effect.parity() == Parity::odd) return along_motion;
  Eigen::MatrixXd both(any.rows(), 2 * any.cols());
  both << any, along_motion;
  return both;
}

double gain_of(RefinedEffect const& candidate, CandidateColumns const& columns, Eigen::VectorXd const& mismatch) {
  OrthonormalGroup const group = columns.group(*candidate.effect, candidate.shape);
  return bounded_gain(group, group.q.transpose() * mismatch).gain;
}

}  // namespace

bool is_form_of(Effect const& named, double named_gain, RefinedEffect const& candidate, ModelStage const& stage,
                CandidateColumns const& columns) {
  if (named.signature().empty() || is_spectrum(named.signature().front())) return false;
  if (candidate.gain > what_a_form_may_cost * named_gain) return false;
  Eigen::VectorXd const mismatch = stage.mismatch();
  CandidateColumns beside = columns;
  beside.add_nuisance(forms_of(named, stage));
  return gain_of(candidate, beside, mismatch) < most_beside_it * gain_of(candidate, columns, mismatch);
}

}  // namespace torquescope
