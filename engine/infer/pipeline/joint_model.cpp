#include "engine/infer/pipeline/joint_model.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {

JointModel::JointModel(Regressor const& regressor, BaselineReference reference, std::vector<ShapedEffect> effects)
    : regressor_(&regressor), reference_(std::move(reference)), effects_(std::move(effects)) {
  TORQUESCOPE_EXPECT(effects_.empty() || static_cast<std::size_t>(reference_.parameters.size()) == regressor.size());
}

std::shared_ptr<Eigen::VectorXd const> gear_load_of(Recording const& recording) {
  return recording.gear_load.size() > 0 ? std::make_shared<Eigen::VectorXd const>(recording.gear_load) : nullptr;
}

void JointModel::load_as_in(Recording const& recording) {
  reference_.gear_load = gear_load_of(recording);
  reference_.given = recording.given;
  reference_.rate_hz = recording.rate_hz;
}

std::size_t JointModel::size() const { return first_parameter(effects_.size()); }

std::size_t JointModel::first_parameter(std::size_t effect) const {
  std::size_t first = regressor_->size();
  for (std::size_t i = 0; i < effect; ++i) first += effects_[i].effect->n_linear();
  return first;
}

std::vector<RegressorColumn> JointModel::column_owners() const {
  std::vector<RegressorColumn> owners = regressor_->column_owners();
  for (std::size_t i = 0; i < effects_.size(); ++i)
    for (std::size_t k = 0; k < effects_[i].effect->n_linear(); ++k) {
      auto const& parameter = effects_[i].effect->parameters()[k];
      owners.push_back({parameter.name, parameter.unit_for(regressor_->joint()), regressor_->terms().size() + i});
    }
  return owners;
}

std::vector<bool> JointModel::non_negative() const {
  std::vector<bool> signs(regressor_->size(), false);
  for (auto const& [effect, shape] : effects_)
    for (std::size_t k = 0; k < effect->n_linear(); ++k)
      signs.push_back(effect->parameters()[k].sign() == Sign::non_negative);
  return signs;
}

Eigen::MatrixXd JointModel::columns(Motion const& motion, Motion const& drive) const {
  if (effects_.empty()) return regressor_->columns(motion, reference_.given.get());
  Eigen::MatrixXd all(motion.q.size(), static_cast<Eigen::Index>(size()));
  all.leftCols(static_cast<Eigen::Index>(regressor_->size())) = regressor_->columns(motion, reference_.given.get());
  FittedBaseline const baseline = on_motion(*regressor_, reference_, motion);
  EffectInput input = baseline.input(motion);
  input.given = reference_.given.get();
  EffectInput const driven{drive, reference_.scales};
  for (std::size_t i = 0; i < effects_.size(); ++i)
    effects_[i].effect->columns(effects_[i].effect->has_inertia() ? driven : input, effects_[i].shape,
                                all.middleCols(static_cast<Eigen::Index>(first_parameter(i)),
                                               static_cast<Eigen::Index>(effects_[i].effect->n_linear())));
  return all;
}

std::vector<double> JointModel::effect_parameters(std::size_t effect, Eigen::VectorXd const& parameters) const {
  auto const first = static_cast<Eigen::Index>(first_parameter(effect));
  auto const& shaped = effects_[effect];
  std::vector<double> all(shaped.effect->n_linear());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = parameters[first + static_cast<Eigen::Index>(k)];
  all.insert(all.end(), shaped.shape.begin(), shaped.shape.end());
  return all;
}

ReplicateJoint JointModel::replicate_joint(Eigen::VectorXd const& parameters) const {
  TORQUESCOPE_EXPECT(static_cast<std::size_t>(parameters.size()) == size());
  ReplicateJoint joint =
      make_replicate_joint(*regressor_, parameters.head(static_cast<Eigen::Index>(regressor_->size())));
  LaneBaseline const beside{joint.lanes, reference_.gear_load, reference_.rate_hz, reference_.given};
  double const* value = parameters.data();
  for (auto const* term : regressor_->terms()) {
    double const* const own = value;
    value += term->n_linear();
    if (term->is_given()) joint.effects.push_back(lane_effect(*term, {own, value}, reference_.scales, beside));
  }
  for (std::size_t i = 0; i < effects_.size(); ++i)
    joint.effects.push_back(
        lane_effect(*effects_[i].effect, effect_parameters(i, parameters), reference_.scales, beside));
  return joint;
}

FittedBaseline on_motion(Regressor const& regressor, BaselineReference const& reference, Motion const& motion) {
  FittedBaseline baseline =
      fitted_baseline(regressor, {reference.parameters.data(), static_cast<std::size_t>(reference.parameters.size())},
                      motion, reference.scales.cutoff_hz, reference.scales.encoder_step, reference.beside_motion());
  baseline.scales = reference.scales;
  return baseline;
}

}  // namespace torquescope
