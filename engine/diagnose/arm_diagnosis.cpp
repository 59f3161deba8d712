#include "engine/diagnose/arm_diagnosis.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/diagnose/first_look.hpp"
#include "engine/diagnose/rigid_rows.hpp"
#include "engine/pipeline/held_torque.hpp"
#include "engine/statistics/blocked_cv.hpp"
#include "engine/words/arm_sentences.hpp"
#include "engine/words/sentences.hpp"

namespace torquescope {
namespace {

// terms of a joint's own equation of motion
Regressor own_terms(ArmModel const& model, std::size_t joint) {
  std::vector<std::string> terms{"inertia"};
  auto const& friction = model.friction()[joint];
  if (friction)
    for (Effect const* effect : friction->terms()) terms.push_back(effect->name());
  return {terms, model.chain().joints[joint].kind, friction ? friction->velocity_deadband() : 0.0};
}

JointOutcome hopeless_joint(DiagnosisInput const& input, Hopeless const& why) {
  Diagnosis diagnosis;
  diagnosis.verdict = why.verdict;
  diagnosis.finding = why.finding;
  diagnosis.way_out = why.way_out;
  JointDiagnosis joint;
  bool const revolute = input.regressor.joint() == JointKind::revolute;
  joint.joint = input.joint;
  joint.unit_position = revolute ? "rad" : "m";
  joint.unit_torque = revolute ? "N m" : "N";
  diagnosis.joints.push_back(std::move(joint));
  diagnosis.reason = reason_sentence(diagnosis);
  return {std::move(diagnosis), {}};
}

class ArmWork {
 public:
  ArmWork(ArmDiagnosisInput const& input, StageSink const& progress)
      : input_(input), progress_(progress), laws_(input.model.joints()) {}

  Diagnosis run() {
    fit();
    std::vector<JointOutcome> outcomes(input_.model.joints());
    std::vector<Eigen::VectorXd> searched_on(outcomes.size());
    auto const search = [&] {
      for (std::size_t j = 0; j < outcomes.size(); ++j) {
        if (!has_moved(j, searched_on[j])) continue;
        outcomes[j] = searched(j);
        searched_on[j] = train_.front()[j].gear_load;
      }
    };
    search();
    for (auto strongest = strongest_new(outcomes); strongest; strongest = strongest_new(outcomes)) {
      laws_[*strongest] = outcomes[*strongest].laws;
      fit();
      search();
    }
    Diagnosis diagnosis;
    diagnosis.seed = input_.seed;
    diagnosis.q = input_.selection.q;
    for (auto& outcome : outcomes) diagnosis.joints.push_back(joint_of(outcome.diagnosis));
    diagnosis.verdict = verdict_of_arm(diagnosis.joints);
    diagnosis.reason = arm_reason_sentence(diagnosis);
    return diagnosis;
  }

 private:
  static JointDiagnosis joint_of(Diagnosis& made) {
    JointDiagnosis joint = std::move(made.joints.front());
    joint.verdict = made.verdict;
    joint.reason = std::move(made.reason);
    return joint;
  }

  // the rigid arm beside what was taken so far, and every joint's recordings without it
  void fit() {
    ArmFilter const filter{input_.filter, input_.filter_section};
    std::vector<RecordedArm> beside_laws = input_.train;
    for (std::size_t j = 0; j < laws_.size(); ++j)
      for (std::size_t k = 0; k < beside_laws.size() && !laws_[j].empty(); ++k)
        beside_laws[k].joints[j].torque -= torque_to_hold(laws_[j][k]);
    fitted_ = fit_arm(input_.model, beside_laws, filter);
    train_.clear();
    unseen_.clear();
    for (auto const& recording : input_.train) train_.push_back(joints_alone(input_.model, fitted_, recording, filter));
    for (auto const& recording : input_.validate)
      unseen_.push_back(joints_alone(input_.model, fitted_, recording, filter));
  }

  // Whether the joint's rigid torque differs from the one it was last searched with, by more than a tenth of its noise
  bool has_moved(std::size_t j, Eigen::VectorXd const& before) const {
    constexpr double tenth = 0.1;
    if (before.size() == 0) return true;
    double const moved = (train_.front()[j].gear_load - before).norm() / std::sqrt(static_cast<double>(before.size()));
    return moved > tenth * fitted_.noise[static_cast<Eigen::Index>(j)];
  }

  // Of joints whose laws are not yet taken out of the fit, the one whose laws are largest relative to its noise: these
  // bias the shared parameters most
  std::optional<std::size_t> strongest_new(std::vector<JointOutcome> const& outcomes) const {
    std::optional<std::size_t> strongest;
    double most = 0.0;
    for (std::size_t j = 0; j < outcomes.size(); ++j) {
      if (!laws_[j].empty() || outcomes[j].laws.empty()) continue;
      double const noise = fitted_.noise[static_cast<Eigen::Index>(j)];
      double const size = outcomes[j].laws.front().squaredNorm() / (noise * noise);
      if (size <= most) continue;
      most = size;
      strongest = j;
    }
    return strongest;
  }

  JointOutcome searched(std::size_t j) const {
    std::vector<Recording> others;
    for (std::size_t k = 1; k < train_.size(); ++k) others.push_back(train_[k][j]);
    std::vector<std::string> too_short;
    for (auto const& recording : unseen_) {
      bool const is_long = rows_one_way(recording[j], {input_.filter, input_.filter_section}) >= fewest_rows;
      if (is_long)
        others.push_back(recording[j]);
      else
        too_short.push_back(recording[j].name);
    }
    Regressor const regressor = own_terms(input_.model, j);
    DiagnosisInput joint{train_.front()[j], others, regressor, input_.filter, input_.filter_section};
    joint.selection = input_.selection;
    joint.selection.candidates = input_.candidates[j];
    joint.selection.q = input_.selection.q / static_cast<double>(input_.model.joints());  // Bonferroni over joints
    joint.levels = input_.levels;
    joint.twins = input_.twins;
    joint.seed = input_.seed + j;  // replicates of one joint have nothing in common with those of another
    joint.threads = input_.threads;
    joint.ablation = input_.ablation;
    joint.reversals = input_.reversals;
    joint.joint = static_cast<int>(j) + 1;
    joint.further_training = train_.size() - 1;
    joint.exchange = input_.exchange;
    JointOutcome outcome;
    // a joint that hardly moves in one recording is no reason to say nothing of the others
    auto const why = verdict_of(Verdict::insufficient, [&]() -> std::optional<Hopeless> {
      outcome = diagnose_joint(joint, progress_);
      return std::nullopt;
    });
    if (why) outcome = hopeless_joint(joint, *why);
    if (!too_short.empty()) outcome.diagnosis.reason += " " + too_few_rows_sentence(too_short);
    return outcome;
  }

  ArmDiagnosisInput const& input_;
  StageSink const& progress_;
  std::vector<std::vector<Eigen::VectorXd>> laws_;  // [N] that the rigid arm was fitted beside
  FittedArm fitted_{};
  std::vector<std::vector<Recording>> train_, unseen_;  // [file][N] joints alone
};

}  // namespace

Diagnosis diagnose_arm(ArmDiagnosisInput const& input, StageSink const& progress) {
  return ArmWork(input, progress).run();
}

}  // namespace torquescope
