#include "engine/diagnose/all_rows_arm.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/account/arm_sentences.hpp"
#include "engine/account/sentences.hpp"
#include "engine/diagnose/all_rows_diagnosis.hpp"
#include "engine/diagnose/arm_joint.hpp"
#include "engine/diagnose/arms/arm_simulator.hpp"
#include "engine/diagnose/arms/rigid_columns.hpp"
#include "engine/diagnose/first_look.hpp"
#include "engine/infer/all_rows/delay_decision.hpp"
#include "engine/infer/all_rows/pooled_rows.hpp"
#include "engine/infer/validation/unseen_record.hpp"

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
  std::vector<Effect const*> laws{};
};

class ArmOnAllRows {
 public:
  ArmOnAllRows(ArmDiagnosisInput const& input, StageSink const& progress)
      : input_(input),
        progress_(progress),
        filter_{input.filter, input.filter_section},
        joints_(input.model.joints()),
        decided_(joints_),
        outcomes_(joints_) {
    std::vector<RecordedArm> train = input.train, unseen = input.validate;
    if (has_simulator(input.train)) {
      ArmWithoutSimulator apart = without_simulator(input.model, input.train, input.validate, filter_);
      train = std::move(apart.train);
      unseen = std::move(apart.validate);
      parameter_share_ = std::move(apart.parameter_share);
    }
    recordings_.resize(joints_);
    for (auto const* arms : {&train, &unseen})
      for (auto const& arm : *arms) {
        auto alone = joints_with_rigid_rows(input.model, arm, filter_);
        for (std::size_t j = 0; j < joints_; ++j) recordings_[j].push_back(from_zero(std::move(alone[j])));
      }
  }

  Diagnosis run() && {
    for (std::size_t j = 0; j < joints_; ++j) learn_alone(j);
    for (std::size_t j = 0; j < joints_; ++j) decide(j, {});
    refute();
    put_errors();
    Diagnosis diagnosis;
    diagnosis.seed = input_.seed;
    diagnosis.q = input_.selection.q;
    diagnosis.arm = WholeArmDiagnosis{};
    for (auto& outcome : outcomes_) {
      JointDiagnosis joint = std::move(outcome.diagnosis.joints.front());
      joint.verdict = outcome.diagnosis.verdict;
      joint.reason = std::move(outcome.diagnosis.reason);
      diagnosis.joints.push_back(std::move(joint));
    }
    diagnosis.verdict = verdict_of_arm(diagnosis.joints);
    diagnosis.reason = arm_reason_sentence(diagnosis);
    return diagnosis;
  }

 private:
  std::size_t training() const { return input_.train.size(); }

  SharedLaw shared_law(std::size_t j, char const* instead_of) const {
    return {rigid_rows_name, instead_of, rigid_parameters(input_.model, j),
            static_cast<Eigen::Index>(input_.model.size())};
  }

  // what the rows of a joint tell of the arm's masses, beside a model of its own in which all of them are free
  void learn_alone(std::size_t j) {
    auto const columns = std::ssize(rigid_parameters(input_.model, j));
    auto const parameters = static_cast<Eigen::Index>(input_.model.size());
    information_.push_back(SharedInformation::none(parameters));
    variances_.push_back(1.0);
    // a joint whose rows tell nothing leaves the masses to the others
    verdict_of(Verdict::insufficient, [&]() -> std::optional<Hopeless> {
      auto const term = rigid_term(rigid_rows_name, columns);
      Regressor const regressor = own_terms(input_.model, j).beside(*term);
      std::vector<Recording> const train(recordings_[j].begin(), recordings_[j].begin() + std::ssize(input_.train));
      DecisionQuestion const question{train, {}, regressor, input_.filter, input_.filter_section};
      JointStrips const strips = joint_strips(question);
      FittedModel const free =
          fitted_model(strips, regressor, {}, nullptr, {DelaySearch::everywhere, question.numbers.longest_delay_s});
      SharedRows const rows = shared_rows(*free.fitted, shared_law(j, rigid_rows_name));
      variances_[j] = independent_variance(rows);
      information_[j] = information_of(rows, variances_[j]);
      return std::nullopt;
    });
  }

  JointOfArm joint_of(std::size_t j) const {
    SharedPart const part = shared_part(information_, j);
    auto const own = rigid_parameters(input_.model, j);
    Eigen::MatrixXd combinations(std::ssize(own), 1 + part.directions.cols());
    combinations << part.known(own), part.directions(own, Eigen::all);
    JointOfArm joint{own_terms(input_.model, j), {}, recordings_[j]};
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
    input.selection = input_.selection;
    input.selection.candidates = input_.candidates[j];
    std::erase_if(input.selection.candidates,
                  [&](Effect const* law) { return std::find(refuted.begin(), refuted.end(), law) != refuted.end(); });
    input.selection.q = input_.selection.q / static_cast<double>(joints_);
    input.levels = input_.levels;
    input.seed = input_.seed + j;  // replicates of one joint have nothing in common with those of another
    input.threads = input_.threads;
    input.joint = static_cast<int>(j) + 1;
    input.further_training = training() - 1;
    if (!parameter_share_.empty()) input.parameter_share = parameter_share_[j];
    decided_[j].reset();
    auto const why = verdict_of(Verdict::insufficient, [&]() -> std::optional<Hopeless> {
      outcomes_[j] = diagnose_on_all_rows(input, of_joint(j), [&](JointDecision const& made) { keep(j, made); });
      return std::nullopt;
    });
    if (why) outcomes_[j] = hopeless_joint(input, *why);
    hide_masses(outcomes_[j].diagnosis.joints.front());
  }

  // combinations of masses are no numbers for people
  static void hide_masses(JointDiagnosis& joint) {
    for (auto* parameters : {&joint.baseline, &joint.augmented})
      std::erase_if(*parameters, [](ParameterEstimate const& one) { return one.name.starts_with(rigid_arm_name); });
  }

  void keep(std::size_t j, JointDecision const& made) {
    SharedLaw const law = shared_law(j, rigid_arm_name);
    DecidedRows rows;
    bool const names_delay = made.facts.delay.is_named;
    rows.baseline = names_delay ? pooled_rows(made.rows, at_allowed_delay(made.rows, made.baseline), law)
                                : pooled_rows(made.rows, made.baseline, law);
    rows.final = pooled_rows(made.rows, made.final, law);
    JointModel const& model = *made.final.model;
    for (std::size_t i = 0; i < made.facts.accepted.size(); ++i) {
      auto effects = model.effects();
      effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(i));
      FittedModel const without =
          fitted_model(made.rows, model.regressor(), std::move(effects), made.final.fitted.get(),
                       {DelaySearch::everywhere, DecisionNumbers{}.longest_delay_s});
      rows.without.push_back(pooled_rows(made.rows, without, law));
      rows.laws.push_back(made.facts.accepted[i].effect);
    }
    decided_[j] = std::move(rows);
  }

  // of all joints that were decided, as named; one of them with other rows
  PooledErrors together(PooledRows DecidedRows::*which, std::size_t instead_at = 0,
                        PooledRows const* instead = nullptr) const {
    std::vector<PooledRows const*> rows;
    std::vector<double> variances;
    for (std::size_t j = 0; j < joints_; ++j) {
      if (!decided_[j]) continue;
      rows.push_back(instead != nullptr && j == instead_at ? instead : &((*decided_[j]).*which));
      variances.push_back(variances_[j]);
    }
    return pooled_errors(rows, variances);
  }

  std::optional<std::size_t> refuted_law(std::size_t j, double judged) const {
    for (std::size_t i = 0; i < decided_[j]->laws.size(); ++i)
      if (!(judged < together(&DecidedRows::final, j, &decided_[j]->without[i]).judged)) return i;
    return std::nullopt;
  }

  void refute() {
    if (std::none_of(decided_.begin(), decided_.end(), [](auto const& one) { return one && !one->laws.empty(); }))
      return;
    for (std::size_t j = 0; j < joints_; ++j) {
      std::vector<Effect const*> refuted;
      while (decided_[j] && !decided_[j]->laws.empty()) {
        auto const law = refuted_law(j, together(&DecidedRows::final).judged);
        if (!law) break;
        refuted.push_back(decided_[j]->laws[*law]);
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
      JointDiagnosis& joint = outcomes_[j].diagnosis.joints.front();
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
      Diagnosis& diagnosis = outcomes_[j].diagnosis;
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
    return own * own < most_of_it * pooled * pooled && beyond > input_.levels.delta * input_.levels.delta;
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
  std::vector<std::vector<Recording>> recordings_{};  // [N][file]
  std::vector<double> parameter_share_{};             // [N] with a simulator
  std::vector<SharedInformation> information_{};      // [N]
  std::vector<double> variances_{};                   // [N]
  std::vector<std::optional<DecidedRows>> decided_;   // [N]; none: hopeless
  std::vector<JointOutcome> outcomes_;                // [N]
};

}  // namespace

Diagnosis diagnose_arm_on_all_rows(ArmDiagnosisInput const& input, StageSink const& progress) {
  return ArmOnAllRows(input, progress).run();
}

}  // namespace torquescope
