#include "engine/diagnose/arm_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/account/arm_sentences.hpp"
#include "engine/account/sentences.hpp"
#include "engine/diagnose/arm_joint.hpp"
#include "engine/diagnose/arms/arm_simulator.hpp"
#include "engine/diagnose/arms/rigid_rows.hpp"
#include "engine/diagnose/arms/whole_arm_search.hpp"
#include "engine/diagnose/beside_shared_arm.hpp"
#include "engine/diagnose/first_look.hpp"
#include "engine/diagnose/whole_arm_account.hpp"
#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/infer/pipeline/held_torque.hpp"

namespace torquescope {
namespace {

// of each joint that has effects which the rigid arm is fitted beside: their torque in each training recording
using LawsOfJoints = std::vector<LawTorques>;

// of the first so many effects
LawTorques sum_of(std::vector<LawTorques> const& laws, std::size_t count) {
  LawTorques sum = laws.front();
  for (std::size_t i = 1; i < count; ++i)
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += laws[i][k];
  return sum;
}

// the rigid arm beside effects, and every joint's recordings without it
struct ArmBesideLaws {
  LawsOfJoints laws{};  // [N]
  FittedArm fitted{};
  std::vector<std::vector<Recording>> train{}, unseen{};  // [file][N] joints alone
};

// whether a joint's own rows may correct the rigid arm (rigid_corrections.hpp)
enum class RigidArm { shared, corrected };

class ArmWork {
 public:
  ArmWork(ArmDiagnosisInput const& input, StageSink const& progress)
      : input_(input),
        progress_(progress),
        filter_{input.filter, input.filter_section},
        train_(input.train),
        unseen_(input.validate) {
    if (!has_simulator(input.train)) return;
    ArmWithoutSimulator apart = without_simulator(input.model, input.train, input.validate, filter_);
    train_ = std::move(apart.train);
    unseen_ = std::move(apart.validate);
    parameter_share_ = std::move(apart.parameter_share);
  }

  Diagnosis run() {
    std::size_t const n = input_.model.joints();
    take_laws_of_whole_arm(LawsOfJoints(n));
    arm_ = beside(LawsOfJoints(n));
    for (std::size_t j = 0; j < n; ++j) alone_.push_back(searched(j, RigidArm::shared));
    outcomes_ = alone_;
    searched_on_.resize(n);
    taken_.assign(n, 0);
    for (std::size_t j = 0; j < n; ++j) searched_on_[j] = arm_.train.front()[j].gear_load;
    take_laws_in_turn();
    for (std::size_t j = 0; j < n; ++j)
      if (outcomes_[j].diagnosis.verdict == Verdict::unexplained && try_beside_pilot(j)) take_laws_in_turn();
    // what joints lacked may have hidden what the whole arm lacks
    if (names_anything(arm_.laws) && take_laws_of_whole_arm(arm_.laws)) {
      arm_ = beside(std::move(arm_.laws));
      search_those_that_moved();
      take_laws_in_turn();
    }
    Diagnosis diagnosis;
    diagnosis.seed = input_.seed;
    diagnosis.q = input_.selection.q;
    diagnosis.arm = account_for_whole_arm(answers_, {names_of(train_), names_of(unseen_)}, whole_arm_level());
    for (auto& outcome : outcomes_) diagnosis.joints.push_back(joint_of(outcome.diagnosis));
    credit_laws_of_whole_arm(diagnosis.joints);
    diagnosis.verdict = verdict_of_arm(diagnosis.joints, diagnosis.arm->effects);
    diagnosis.reason = arm_reason_sentence(diagnosis);
    return diagnosis;
  }

 private:
  double whole_arm_level() const { return whole_arm_share * input_.selection.q; }

  static std::vector<std::string> names_of(std::vector<RecordedArm> const& recordings) {
    std::vector<std::string> names;
    for (auto const& one : recordings) names.push_back(one.joints.front().name);
    return names;
  }

  static bool names_anything(LawsOfJoints const& laws) {
    return std::any_of(laws.begin(), laws.end(), [](auto const& of_joint) { return !of_joint.empty(); });
  }

  // Takes out of all recordings what acts on several joints at once, as far as it shows beside their effects. Whether
  // there was any
  bool take_laws_of_whole_arm(LawsOfJoints const& beside_laws) {
    if (progress_) progress_("whole arm", 0, 1);
    std::vector<RecordedArm> const train = less(beside_laws);
    WholeArmQuestion const question{
        input_.model,      train,       unseen_,       filter_, input_.candidates.front(), input_.levels,
        whole_arm_level(), input_.seed, input_.threads};
    answers_.push_back(search_whole_arm(question));
    auto const& accepted = answers_.back().accepted;
    if (!accepted.empty()) {
      for (std::size_t k = 0; k < train_.size(); ++k) take_out(train_[k], question, accepted, {train[k], k, false});
      for (std::size_t k = 0; k < unseen_.size(); ++k) take_out(unseen_[k], question, accepted, {unseen_[k], k, true});
    }
    if (progress_) progress_("whole arm", 1, 1);
    return !accepted.empty();
  }

  static void take_out(RecordedArm& recording, WholeArmQuestion const& question,
                       std::vector<FoundWholeArmLaw> const& accepted, OneRecording const& of) {
    auto const torques = whole_arm_torques(question, accepted, of);
    for (std::size_t j = 0; j < torques.size(); ++j) {
      Recording& joint = recording.joints[j];
      joint.torque -= torque_to_hold(torques[j]);
      // it passes the gear all the same
      joint.gear_load = joint.gear_load.size() > 0 ? (joint.gear_load + torques[j]).eval() : torques[j];
    }
  }

  static JointDiagnosis joint_of(Diagnosis& made) {
    JointDiagnosis joint = std::move(made.joints.front());
    joint.verdict = made.verdict;
    joint.reason = std::move(made.reason);
    return joint;
  }

  // A joint most of whose mismatch an effect of the whole arm explains is not unexplained: what is left of it is
  void credit_laws_of_whole_arm(std::vector<JointDiagnosis>& joints) const {
    for (auto const& answer : answers_)
      for (auto const& law : answer.accepted)
        for (std::size_t j = 0; j < joints.size(); ++j) {
          double const share = law.explained_at[static_cast<Eigen::Index>(j)];
          if (joints[j].verdict != Verdict::unexplained || share <= most_of_it) continue;
          joints[j].verdict = Verdict::partly;
          joints[j].explained_share = share;
          joints[j].reason = explained_by_arm_sentence(law.law.effect->name(), share) + " " + joints[j].reason;
        }
  }

  std::vector<RecordedArm> less(LawsOfJoints const& laws) const {
    std::vector<RecordedArm> left = train_;
    for (std::size_t j = 0; j < laws.size(); ++j)
      for (std::size_t k = 0; k < left.size() && !laws[j].empty(); ++k)
        left[k].joints[j].torque -= torque_to_hold(laws[j][k]);
    return left;
  }

  // Effects of a joint beside those of the others, as large as a fit of them and the arm together has them: beside an
  // arm that was fitted without them they come out too small
  LawsOfJoints with_laws(std::size_t j, LawTorques const& found) const {
    LawsOfJoints laws = arm_.laws;
    Eigen::VectorXd const& noise = arm_.fitted.noise;
    auto const left_beside = [&](double size) {
      laws[j].clear();
      for (auto const& torque : found) laws[j].emplace_back(size * torque);
      double left = 0.0;
      auto const energies = fit_parameters(input_.model, less(laws), filter_, noise).energies;
      for (std::size_t i = 0; i < energies.size(); ++i) {
        double const own = noise[static_cast<Eigen::Index>(i)];
        left += energies[i].left / (own * own);
      }
      return left;
    };
    // the energy is a parabola in the size: three points tell its lowest one
    double const none = left_beside(0.0), once = left_beside(1.0), twice = left_beside(2.0);
    double const curvature = none - 2.0 * once + twice;
    double const best = curvature > 0.0 ? 1.0 + 0.5 * (none - twice) / curvature : 1.0;
    laws[j].clear();
    for (auto const& torque : found) laws[j].emplace_back(std::max(1.0, best) * torque);
    return laws;
  }

  ArmBesideLaws beside(LawsOfJoints laws) const {
    ArmBesideLaws arm;
    arm.fitted = fit_arm(input_.model, less(laws), filter_);
    arm.laws = std::move(laws);
    for (auto const& recording : train_)
      arm.train.push_back(joints_alone(input_.model, arm.fitted, recording, filter_));
    for (auto const& recording : unseen_)
      arm.unseen.push_back(joints_alone(input_.model, arm.fitted, recording, filter_));
    return arm;
  }

  // One effect at a time, the strongest first, until none is new to the fit of the arm. Of a joint with several the
  // first alone: beside an arm that lacks it, the next may be no more than what the arm was bent by it
  void take_laws_in_turn() {
    for (auto strongest = strongest_new(); strongest; strongest = strongest_new()) {
      std::size_t& taken = taken_[*strongest];
      ++taken;
      arm_ = beside(with_laws(*strongest, sum_of(outcomes_[*strongest].laws, taken)));
      search_those_that_moved();
    }
  }

  void search_those_that_moved() {
    for (std::size_t j = 0; j < outcomes_.size(); ++j) {
      if (!has_moved(j)) continue;
      outcomes_[j] = searched_beside_laws(j);
      searched_on_[j] = arm_.train.front()[j].gear_load;
    }
  }

  // A joint without names is told as it is beside the effects of others, but not beside an arm that lacks its own
  JointOutcome searched_beside_laws(std::size_t j) const {
    JointOutcome outcome = searched(j, RigidArm::shared);
    if (arm_.laws[j].empty() && outcome.diagnosis.joints.front().effects.empty()) return outcome;
    return beside_shared_arm(alone_[j], std::move(outcome), input_.levels, filter_memory());
  }

  // rows that the parallel filter couples, of the joints' rows
  Eigen::Index filter_memory() const {
    Recording const& first = train_.front().joints.front();
    Regressor const terms = own_terms(input_.model, 0);
    return guard_rows({terms, input_.filter, first.rate_hz, first.position.size(), input_.filter_section});
  }

  // A missing effect bends the rigid arm, which then hides it. Where a joint stays unexplained, a search that may
  // correct the arm at that joint is the pilot: beside what it finds the arm is fitted anew, and the joint is judged
  // beside that arm. Whether names came of it
  bool try_beside_pilot(std::size_t j) {
    JointOutcome const pilot = searched(j, RigidArm::corrected);
    if (pilot.tried.empty()) return false;
    ArmBesideLaws before = arm_;
    arm_ = beside(with_laws(j, sum_of(pilot.tried, pilot.tried.size())));
    JointOutcome again = searched_beside_laws(j);
    if (again.laws.empty() || !names_physics(again.diagnosis.verdict)) {
      arm_ = std::move(before);
      return false;
    }
    outcomes_[j] = std::move(again);
    searched_on_[j] = arm_.train.front()[j].gear_load;
    arm_.laws[j].clear();  // to be taken as they were found last
    taken_[j] = 0;
    return true;
  }

  // Whether the joint's rigid torque differs from the one it was last searched with, by more than a tenth of its noise
  bool has_moved(std::size_t j) const {
    constexpr double tenth = 0.1;
    Eigen::VectorXd const& before = searched_on_[j];
    double const moved =
        (arm_.train.front()[j].gear_load - before).norm() / std::sqrt(static_cast<double>(before.size()));
    return moved > tenth * arm_.fitted.noise[static_cast<Eigen::Index>(j)];
  }

  // Of joints with an effect that is not yet taken out of the fit, the one with the largest relative to its noise:
  // these bias the shared parameters most
  std::optional<std::size_t> strongest_new() const {
    std::optional<std::size_t> strongest;
    double most = 0.0;
    for (std::size_t j = 0; j < outcomes_.size(); ++j) {
      auto const& laws = outcomes_[j].laws;
      if (laws.size() <= taken_[j]) continue;
      double const noise = arm_.fitted.noise[static_cast<Eigen::Index>(j)];
      double const size = sum_of(laws, taken_[j] + 1).front().squaredNorm() / (noise * noise);
      if (size <= most) continue;
      most = size;
      strongest = j;
    }
    return strongest;
  }

  JointOutcome searched(std::size_t j, RigidArm rigid) const {
    std::vector<Recording> others;
    for (std::size_t k = 1; k < arm_.train.size(); ++k) others.push_back(arm_.train[k][j]);
    std::vector<std::string> too_short;
    for (auto const& recording : arm_.unseen) {
      bool const is_long = rows_one_way(recording[j], filter_) >= fewest_rows;
      if (is_long)
        others.push_back(recording[j]);
      else
        too_short.push_back(recording[j].name);
    }
    Regressor regressor = own_terms(input_.model, j);
    std::unique_ptr<Effect const> term;
    if (RigidCorrections const& free = arm_.fitted.corrections[j]; rigid == RigidArm::corrected && free.size() > 0) {
      term = correction_term(free.size());
      regressor = regressor.beside(*term);
    }
    DiagnosisInput joint{arm_.train.front()[j], others, regressor, input_.filter, input_.filter_section};
    joint.selection = input_.selection;
    joint.selection.candidates = input_.candidates[j];
    joint.selection.q = level_of_joint(input_.selection.q, input_.model.joints());
    joint.levels = input_.levels;
    joint.twins = input_.twins;
    joint.seed = input_.seed + j;  // replicates of one joint have nothing in common with those of another
    joint.threads = input_.threads;
    joint.ablation = input_.ablation;
    joint.reversals = input_.reversals;
    joint.joint = static_cast<int>(j) + 1;
    joint.further_training = arm_.train.size() - 1;
    joint.exchange = input_.exchange;
    if (!parameter_share_.empty()) joint.parameter_share = parameter_share_[j];
    StageSink const progress = of_joint(j);
    JointOutcome outcome;
    // a joint that hardly moves in one recording is no reason to say nothing of the others
    auto const why = verdict_of(Verdict::insufficient, [&]() -> std::optional<Hopeless> {
      outcome = diagnose_joint(joint, progress);
      return std::nullopt;
    });
    if (why) outcome = hopeless_joint(joint, *why);
    if (!too_short.empty()) outcome.diagnosis.reason += " " + too_few_rows_sentence(too_short);
    return outcome;
  }

  // stages of one joint after the other
  StageSink of_joint(std::size_t j) const {
    if (!progress_) return {};
    return [this, lead = "joint" + std::to_string(j + 1) + ":"](
               std::string const& stage, std::size_t done, std::size_t total) { progress_(lead + stage, done, total); };
  }

  ArmDiagnosisInput const& input_;
  StageSink const& progress_;
  ArmFilter filter_;
  std::vector<RecordedArm> train_, unseen_;  // less what a simulator and effects of the whole arm explain
  std::vector<double> parameter_share_{};    // [N] with a simulator
  std::vector<WholeArmAnswer> answers_{};
  ArmBesideLaws arm_{};
  std::vector<JointOutcome> alone_{}, outcomes_{};  // [N] beside the arm without effects; as it is told
  std::vector<Eigen::VectorXd> searched_on_{};      // [N] rigid torque of the last search
  std::vector<std::size_t> taken_{};                // [N] effects that the arm is fitted beside
};

}  // namespace

Diagnosis diagnose_arm(ArmDiagnosisInput const& input, StageSink const& progress) {
  return ArmWork(input, progress).run();
}

}  // namespace torquescope
