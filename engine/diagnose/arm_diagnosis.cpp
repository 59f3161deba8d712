#include "engine/diagnose/arm_diagnosis.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/account/arm_sentences.hpp"
#include "engine/account/sentences.hpp"
#include "engine/diagnose/arm_joint.hpp"
#include "engine/diagnose/arm_masses.hpp"
#include "engine/diagnose/arms/arm_simulator.hpp"
#include "engine/diagnose/arms/rigid_columns.hpp"
#include "engine/diagnose/first_look.hpp"
#include "engine/diagnose/whole_arm_account.hpp"
#include "engine/diagnose/whole_arm_stage.hpp"
#include "engine/infer/decision/delay_decision.hpp"
#include "engine/infer/decision/pooled_rows.hpp"

namespace torquescope {
namespace {

// one joint's model and all its recordings: those of training first
struct JointOfArm {
  Regressor regressor;
  std::unique_ptr<Effect const> term{};
  std::vector<Recording> recordings{};
};

// a joint's rows as decided: without its names, with them, and with all of them but one
struct DecidedRows {
  PooledRows baseline{}, final{};
  std::vector<PooledRows> without{};
  std::vector<Effect const*> effects{};
};

class ArmWork {
 public:
  ArmWork(ArmDiagnosisInput const& input, StageSink const& progress)
      : input_(input),
        progress_(progress),
        filter_{input.filter, input.filter_section},
        joints_(input.model.joints()),
        decided_(joints_),
        outcomes_(joints_) {
    std::vector<RecordedArm> train = input.train, validation = input.validate;
    if (has_simulator(input.train)) {
      ArmWithoutSimulator apart = without_simulator(input.model, input.train, input.validate, filter_);
      train = std::move(apart.train);
      validation = std::move(apart.validate);
      parameter_share_ = std::move(apart.parameter_share);
    }
    train.insert(train.end(), std::make_move_iterator(validation.begin()), std::make_move_iterator(validation.end()));
    arm_ = learnt_arm(input, std::move(train), filter_);
  }

  Diagnosis run() && {
    take_effects_of_whole_arm();
    decide_all();
    // what joints lacked may have hidden what the whole arm lacks
    if (names_anything() && take_effects_of_whole_arm()) decide_all();
    refute();
    put_errors();
    Diagnosis diagnosis;
    diagnosis.seed = input_.seed;
    diagnosis.q = input_.numbers.alpha;
    diagnosis.arm = account_for_whole_arm(answers_, {arm_.files.names(true), arm_.files.names(false)},
                                          input_.numbers.alpha_of_whole_arm());
    for (auto& outcome : outcomes_) {
      JointDiagnosis joint = std::move(outcome.joints.front());
      joint.verdict = outcome.verdict;
      joint.reason = std::move(outcome.reason);
      diagnosis.joints.push_back(std::move(joint));
    }
    credit_effects_of_whole_arm(answers_, input_.numbers.most_of_it, diagnosis.joints);
    diagnosis.verdict = verdict_of_arm(diagnosis.joints, diagnosis.arm->effects);
    diagnosis.reason = arm_reason_sentence(diagnosis);
    return diagnosis;
  }

 private:
  std::size_t training() const { return input_.train.size(); }

  // whether any were found
  bool take_effects_of_whole_arm() {
    if (progress_) progress_("whole arm", 0, 1);
    answers_.push_back(effects_of_whole_arm(input_, {arm_.effects, arm_.rows, arm_.noise()}));
    auto const& accepted = answers_.back().accepted;
    if (!accepted.empty()) arm_ = learnt_arm(input_, without_effects(input_, arm_.files, filter_, accepted), filter_);
    if (progress_) progress_("whole arm", 1, 1);
    return !accepted.empty();
  }

  void decide_all() {
    for (std::size_t j = 0; j < joints_; ++j) decide(j, {});
  }

  bool names_anything() const {
    return std::any_of(decided_.begin(), decided_.end(), [](auto const& one) { return one && !one->effects.empty(); });
  }

  JointOfArm joint_of(std::size_t j) const {
    SharedPart const part = shared_part(arm_.information, j);
    auto const own = rigid_parameters(input_.model, j);
    Eigen::MatrixXd combinations(std::ssize(own), 1 + part.directions.cols());
    combinations << part.known(own), part.directions(own, Eigen::all);
    JointOfArm joint{own_terms(input_.model, j), {}, arm_.recordings[j]};
    Eigen::Index const columns = add_rigid_arm(joint.recordings, training(), combinations, filter_);
    if (columns == 0) return joint;
    joint.term = rigid_term(rigid_arm_name, columns);
    joint.regressor = joint.regressor.beside(*joint.term);
    return joint;
  }

  void decide(std::size_t j, std::vector<Effect const*> const& refuted) {
    JointOfArm const joint = joint_of(j);
    std::vector<Recording> const others(joint.recordings.begin() + 1, joint.recordings.end());
    DiagnosisInput input{joint.recordings.front(), others, joint.regressor, input_.filter, input_.filter_section};
    input.candidates = input_.candidates[j];
    input.max_effects = input_.max_effects;
    std::erase_if(input.candidates, [&](Effect const* effect) {
      return std::find(refuted.begin(), refuted.end(), effect) != refuted.end();
    });
    input.numbers = input_.numbers;
    input.numbers.alpha = input_.numbers.alpha_of_joint(joints_);
    input.seed = input_.seed + j;  // replicates of one joint have nothing in common with those of another
    input.threads = input_.threads;
    input.joint = static_cast<int>(j) + 1;
    input.further_training = training() - 1;
    if (!parameter_share_.empty()) input.parameter_share = parameter_share_[j];
    decided_[j].reset();
    auto const why = verdict_of(Verdict::insufficient, [&]() -> std::optional<Hopeless> {
      outcomes_[j] = diagnose_joint(input, of_joint(j), [&](JointDecision const& made) { keep(j, made); });
      return std::nullopt;
    });
    if (why) outcomes_[j] = hopeless_joint(input, *why);
    hide_masses(outcomes_[j].joints.front());
  }

  // combinations of masses are no numbers for people
  static void hide_masses(JointDiagnosis& joint) {
    for (auto* parameters : {&joint.baseline, &joint.augmented})
      std::erase_if(*parameters, [](ParameterEstimate const& one) { return one.name.starts_with(rigid_arm_name); });
  }

  void keep(std::size_t j, JointDecision const& made) {
    SharedEffect const effect = shared_masses(input_.model, j, rigid_arm_name);
    DecidedRows rows;
    bool const names_delay = made.facts.delay.is_named;
    rows.baseline = names_delay ? pooled_rows(made.rows, at_allowed_delay(made.rows, made.baseline), effect)
                                : pooled_rows(made.rows, made.baseline, effect);
    rows.final = pooled_rows(made.rows, made.final, effect);
    JointModel const& model = *made.final.model;
    for (std::size_t i = 0; i < made.facts.accepted.size(); ++i) {
      auto effects = model.effects();
      effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(i));
      FittedModel const without =
          fitted_model(made.rows, model.regressor(), std::move(effects), made.final.fitted.get(),
                       {DelaySearch::everywhere, DecisionNumbers{}.longest_delay_s});
      rows.without.push_back(pooled_rows(made.rows, without, effect));
      rows.effects.push_back(made.facts.accepted[i].effect);
    }
    decided_[j] = std::move(rows);
    arm_.rows[j] = rows_for_whole_arm(arm_, made.rows, made.final, effect, j);
  }

  // of all joints that were decided, as named; one of them with other rows
  PooledErrors together(PooledRows DecidedRows::*which, std::size_t instead_at = 0,
                        PooledRows const* instead = nullptr) const {
    std::vector<PooledRows const*> rows;
    std::vector<double> variances;
    for (std::size_t j = 0; j < joints_; ++j) {
      if (!decided_[j]) continue;
      rows.push_back(instead != nullptr && j == instead_at ? instead : &((*decided_[j]).*which));
      variances.push_back(arm_.variances[j]);
    }
    return pooled_errors(rows, variances);
  }

  std::optional<std::size_t> refuted_effect(std::size_t j, double judged) const {
    for (std::size_t i = 0; i < decided_[j]->effects.size(); ++i)
      if (!(judged < together(&DecidedRows::final, j, &decided_[j]->without[i]).judged)) return i;
    return std::nullopt;
  }

  void refute() {
    if (!names_anything()) return;
    for (std::size_t j = 0; j < joints_; ++j) {
      std::vector<Effect const*> refuted;
      while (decided_[j] && !decided_[j]->effects.empty()) {
        auto const effect = refuted_effect(j, together(&DecidedRows::final).judged);
        if (!effect) break;
        refuted.push_back(decided_[j]->effects[*effect]);
        decide(j, refuted);
      }
    }
  }

  void put_errors() {
    if (std::none_of(decided_.begin(), decided_.end(), [](auto const& one) { return one.has_value(); })) return;
    PooledErrors const before = together(&DecidedRows::baseline), after = together(&DecidedRows::final);
    std::size_t place = 0;
    for (std::size_t j = 0; j < joints_; ++j) {
      if (!decided_[j]) continue;
      JointDiagnosis& joint = outcomes_[j].joints.front();
      ModelErrors const &plain = before.of_joints[place], &named = after.of_joints[place++];
      joint.train_relerr = plain.train;
      joint.cv_relerr = plain.held_out;
      joint.validation_relerr = plain.validation;
      joint.validation_torque_energy = decided_[j]->final.validation_energy;
      if (!joint.effects.empty()) {
        joint.augmented_train_relerr = named.train;
        joint.augmented_cv_relerr = named.held_out;
        joint.augmented_validation_relerr = named.validation;
      }
      Diagnosis& diagnosis = outcomes_[j];
      ModelErrors const own = own_errors(*joint.decision);
      bool const contradicts = contradicts_others(own.judged(), named.judged());
      if (contradicts) has_riddle(diagnosis);
      diagnosis.reason = whole_reason(diagnosis);
      if (contradicts) diagnosis.reason += " " + own_masses_sentence(own.judged(), named.judged());
    }
  }

  static ModelErrors own_errors(DecisionAccount const& account) {
    return {account.final.train, account.final.held_out, account.final.validation};
  }

  // whether sharing the masses leaves more of a joint than all else does
  bool contradicts_others(double own, double pooled) const {
    double const beyond = pooled * pooled - own * own;
    return own * own < input_.numbers.most_of_it * pooled * pooled &&
           beyond > input_.numbers.delta * input_.numbers.delta;
  }

  static void has_riddle(Diagnosis& diagnosis) {
    diagnosis.finding.clear();
    diagnosis.way_out.clear();
    diagnosis.verdict = diagnosis.joints.front().effects.empty() ? Verdict::unexplained : Verdict::partly;
    diagnosis.joints.front().verdict = diagnosis.verdict;
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
  std::size_t joints_;
  LearntArm arm_{};
  std::vector<double> parameter_share_{};            // [N] with a simulator
  std::vector<std::optional<DecidedRows>> decided_;  // [N]; none: hopeless
  std::vector<WholeArmAnswer> answers_{};
  std::vector<Diagnosis> outcomes_;  // [N]
};

}  // namespace

Diagnosis diagnose_arm(ArmDiagnosisInput const& input, StageSink const& progress) {
  return ArmWork(input, progress).run();
}

}  // namespace torquescope
