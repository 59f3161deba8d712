#include "engine/diagnose/arm_masses.hpp"

#include <span>
#include <utility>

#include "engine/diagnose/arm_joint.hpp"
#include "engine/diagnose/arms/rigid_columns.hpp"
#include "engine/diagnose/first_look.hpp"

namespace torquescope {
namespace {

struct MassesOfJoint {
  SharedInformation information{};
  double variance = 1.0;
  std::optional<ArmRowsOfJoint> rows{};
};

MassesOfJoint masses_of_joint(ArmDiagnosisInput const& input, LearntArm const& arm, std::size_t joint) {
  MassesOfJoint told{SharedInformation::none(static_cast<Eigen::Index>(input.model.size())), 1.0, {}};
  verdict_of(Verdict::insufficient, [&]() -> std::optional<Hopeless> {
    auto const term = rigid_term(rigid_rows_name, std::ssize(rigid_parameters(input.model, joint)));
    Regressor const regressor = own_terms(input.model, joint).beside(*term);
    std::span<Recording const> const all = arm.recordings[joint];
    DecisionQuestion const question{all.first(arm.files.training), all.subspan(arm.files.training), regressor,
                                    input.filter, input.filter_section};
    JointStrips const strips = joint_strips(question);
    FittedModel const free =
        fitted_model(strips, regressor, {}, nullptr, {DelaySearch::everywhere, question.numbers.longest_delay_s});
    SharedEffect const effect = shared_masses(input.model, joint, rigid_rows_name);
    SharedRows const rows = shared_rows(*free.fitted, effect);
    told.variance = independent_variance(rows);
    told.information = information_of(rows, told.variance);
    told.rows = rows_for_whole_arm(arm, strips, free, effect, joint);
    return std::nullopt;
  });
  return told;
}

}  // namespace

SharedEffect shared_masses(ArmModel const& model, std::size_t joint, char const* instead_of) {
  return {rigid_rows_name, instead_of, rigid_parameters(model, joint), static_cast<Eigen::Index>(model.size())};
}

std::optional<ArmRowsOfJoint> rows_for_whole_arm(LearntArm const& arm, JointStrips const& strips,
                                                 FittedModel const& model, SharedEffect const& effect,
                                                 std::size_t joint) {
  if (arm.effects.empty()) return std::nullopt;
  return rows_of_joint({joint, strips, model, effect, arm.files.begins_s(joint)}, effect_columns(arm.effects));
}

Eigen::VectorXd LearntArm::noise() const {
  return Eigen::VectorXd::Map(variances.data(), std::ssize(variances)).cwiseSqrt();
}

LearntArm learnt_arm(ArmDiagnosisInput const& input, std::vector<RecordedArm> arms, ArmFilter const& filter) {
  std::size_t const joints = input.model.joints();
  LearntArm arm;
  arm.files = arm_files(input, std::move(arms), filter);
  arm.recordings.resize(joints);
  JointsOfArm alone = joints_of(arm.files, input.model, filter, input.threads);
  arm.effects = std::move(alone.effects);
  for (auto& file : alone.files)
    for (std::size_t j = 0; j < joints; ++j) arm.recordings[j].push_back(std::move(file[j]));
  for (std::size_t j = 0; j < joints; ++j) {
    MassesOfJoint told = masses_of_joint(input, arm, j);
    arm.information.push_back(std::move(told.information));
    arm.variances.push_back(told.variance);
    arm.rows.push_back(std::move(told.rows));
  }
  return arm;
}

}  // namespace torquescope
