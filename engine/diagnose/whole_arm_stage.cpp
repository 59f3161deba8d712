#include "engine/diagnose/whole_arm_stage.hpp"

#include <algorithm>
#include <utility>

#include "engine/data/from_zero.hpp"
#include "engine/diagnose/arms/arm_fit.hpp"
#include "engine/diagnose/arms/rigid_columns.hpp"
#include "engine/infer/pipeline/held_torque.hpp"

namespace torquescope {

std::vector<std::string> ArmFiles::names(bool of_training) const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < arms.size(); ++k)
    if ((k < training) == of_training) names.push_back(arms[k].joints.front().name);
  return names;
}

std::vector<double> ArmFiles::begins_s(std::size_t joint) const {
  std::vector<double> begins;
  for (auto const& arm : arms) begins.push_back(arm.joints[joint].time_s[0]);
  return begins;
}

ArmFiles arm_files(ArmDiagnosisInput const& input, std::vector<RecordedArm> arms, ArmFilter const& filter) {
  ArmFiles files{std::move(arms), input.train.size(), {}, {}};
  for (auto const* effect : input.candidates.front())
    if (effect->is_of_whole_arm()) files.wanted.push_back(effect);
  if (files.wanted.empty()) return files;
  files.parameters = fit_parameters(input.model, std::span(files.arms).first(files.training), filter).parameters;
  return files;
}

JointsOfArm joints_of(ArmFiles const& files, ArmModel const& model, ArmFilter const& filter, int threads) {
  JointsOfArm all;
  for (auto const& arm : files.arms) {
    auto joints = joints_with_rigid_rows(model, arm, filter);
    if (!files.wanted.empty()) {
      auto const effects = whole_arm_effects(model, files.parameters, motion_of(arm, filter), files.wanted, threads);
      all.effects = effect_places(effects);
      give_whole_arm_effects(joints, effects);
    }
    for (auto& joint : joints) joint = from_zero(std::move(joint));
    all.files.push_back(std::move(joints));
  }
  return all;
}

WholeArmAnswer effects_of_whole_arm(ArmDiagnosisInput const& input, RowsOfArm const& of) {
  if (of.effects.empty()) return {};
  std::vector<RowsOfJoint const*> training;
  std::vector<std::vector<RowsOfJoint const*>> validation(input.validate.size());
  std::vector<Eigen::Index> own_columns;
  for (auto const& joint : of.rows) {
    if (!joint || joint->training.rows.empty()) continue;
    training.push_back(&joint->training);
    own_columns.push_back(joint->training.model.own.cols());
    for (std::size_t k = 0; k < validation.size(); ++k) validation[k].push_back(&joint->validation[k]);
  }
  WholeArmRows const trained = whole_arm_rows(training, own_columns, of.noise, of.effects);
  std::vector<WholeArmRows> others;
  for (auto const& joints : validation) others.push_back(whole_arm_rows(joints, own_columns, of.noise, of.effects));
  DecisionNumbers numbers = input.numbers;
  numbers.alpha = numbers.alpha_of_whole_arm();
  return search_whole_arm({trained, others, of.noise, numbers, input.seed, input.threads});
}

std::vector<RecordedArm> without_effects(ArmDiagnosisInput const& input, ArmFiles const& files, ArmFilter const& filter,
                                         std::vector<FoundWholeArmEffect> const& accepted) {
  std::vector<RecordedArm> arms = files.arms;
  for (std::size_t k = 0; k < arms.size(); ++k) {
    bool const is_validation = k >= files.training;
    auto const effects =
        whole_arm_effects(input.model, files.parameters, motion_of(files.arms[k], filter), files.wanted, input.threads);
    OneRecording const of{effects, files.arms[k].joints.front().time_s, is_validation ? k - files.training : k,
                          is_validation};
    auto const torques = whole_arm_torques(accepted, of);
    for (std::size_t j = 0; j < torques.size(); ++j) {
      Recording& joint = arms[k].joints[j];
      joint.torque -= torque_to_hold(torques[j]);
      joint.gear_load = joint.gear_load.size() > 0 ? (joint.gear_load + torques[j]).eval() : torques[j];
    }
  }
  return arms;
}

}  // namespace torquescope
