#include "engine/search/form_freedom.hpp"

#include <cmath>
#include <optional>

#include "engine/base/contract.hpp"
#include "engine/locate/map_axes.hpp"
#include "engine/statistics/hat_functions.hpp"

namespace torquescope {
namespace {

constexpr double what_a_form_may_cost = 0.1;
constexpr double what_a_wave_may_cost = 0.25;
constexpr double most_beside_it = 0.5;
constexpr Eigen::Index n_knots_of_form = 12;

// at the full rate
Eigen::MatrixXd forms_of(Effect const& effect, ModelStage const& stage) {
  MotionAxes const axes = motion_axes(stage.model(), stage.comparison.common, stage.parameters());
  SignatureAxis const axis = effect.signature().front();
  Eigen::VectorXd const at = values_on(axis, axes);
  // of the speed: a function of the velocity would be of either parity
  Eigen::MatrixXd any = hats(axis == SignatureAxis::velocity ? at.cwiseAbs() : at, n_knots_of_form);
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

std::optional<double> order_of(Effect const& effect, std::vector<double> const& shape) {
  bool const has_order = effect.n_shape() > 0 && effect.parameters()[effect.n_linear()].is_order();
  return has_order ? std::optional(shape.front()) : std::nullopt;
}

// another kind of wave, of the same order or of twice that as far as this travel can tell
bool is_overtone_of(ShapedEffect const& named, RefinedEffect const& candidate, JointScales const& scales) {
  auto const order = order_of(*named.effect, named.shape), other = order_of(*candidate.effect, candidate.shape);
  if (!order || !other || named.effect == candidate.effect) return false;
  double const a_wave = bound_value({1.0, RelativeTo::lowest_order}, scales);  // over the travel: closer ones overlap
  return std::abs(*other - *order) < a_wave || std::abs(*other - 2.0 * *order) < a_wave;
}

}  // namespace

bool is_form_of(ShapedEffect const& shaped, double named_gain, RefinedEffect const& candidate, ModelStage const& stage,
                CandidateColumns const& columns) {
  Effect const& named = *shaped.effect;
  if (is_overtone_of(shaped, candidate, columns.scales())) return candidate.gain < what_a_wave_may_cost * named_gain;
  if (named.signature().empty() || is_spectrum(named.signature().front())) return false;
  if (candidate.gain > what_a_form_may_cost * named_gain) return false;
  Eigen::VectorXd const mismatch = stage.mismatch();
  CandidateColumns beside = columns;
  beside.add_nuisance(forms_of(named, stage));
  return gain_of(candidate, beside, mismatch) < most_beside_it * gain_of(candidate, columns, mismatch);
}

std::optional<std::size_t> form_of_named(std::span<double const> gains, RefinedEffect const& candidate,
                                         ModelStage const& stage, CandidateColumns const& columns) {
  auto const& effects = stage.model().effects();
  TORQUESCOPE_EXPECT(gains.size() == effects.size());
  for (std::size_t i = 0; i < gains.size(); ++i)
    if (is_form_of(effects[i], gains[i], candidate, stage, columns)) return i;
  return std::nullopt;
}

}  // namespace torquescope
