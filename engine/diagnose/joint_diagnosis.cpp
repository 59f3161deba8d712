#include "engine/diagnose/joint_diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "engine/account/arm_sentences.hpp"
#include "engine/account/error_words.hpp"
#include "engine/account/excitation_advice.hpp"
#include "engine/account/name_list.hpp"
#include "engine/account/sentences.hpp"
#include "engine/account/withdrawn_names.hpp"
#include "engine/base/quantity_text.hpp"
#include "engine/base/torque_unit.hpp"
#include "engine/diagnose/first_look.hpp"
#include "engine/diagnose/joint_search.hpp"
#include "engine/diagnose/model_account.hpp"
#include "engine/diagnose/named_effects.hpp"
#include "engine/diagnose/neighbour_load.hpp"
#include "engine/diagnose/recorded_unit.hpp"
#include "engine/infer/locate/largest_parts.hpp"
#include "engine/infer/locate/mismatch_map.hpp"
#include "engine/infer/moving_rows/kept_model.hpp"
#include "engine/infer/moving_rows/verdict_table.hpp"
#include "engine/infer/pipeline/motion_limits.hpp"
#include "engine/infer/replicates/echoed_reference.hpp"
#include "engine/infer/search/blocked_mismatch.hpp"
#include "engine/infer/search/candidate_table.hpp"
#include "engine/infer/search/channel_timing.hpp"
#include "engine/infer/search/detection_power.hpp"
#include "engine/infer/validation/level_change.hpp"
#include "engine/infer/validation/unseen_nuisances.hpp"
#include "engine/infer/validation/unseen_record.hpp"

namespace torquescope {
namespace {

std::string without_reference_sentence(bool is_echo) {
  std::string const why = is_echo ? "The reference is the measured motion itself, in which no controller shows"
                                  : "No reference was recorded";
  return why +
         ": replicates follow the measured motion, and the torque's noise is read from what the model leaves, so that "
         "small effects hide (reference = \"COLUMN\" in recording.columns: what was commanded).";
}

LeftOut told(LeftOutRows const& rows) {
  return {rows.time_share(), rows.energy_share(), std::sqrt(rows.energy / rows.torque),
          std::sqrt(rows.after / rows.torque), rows.torque};
}

class JointWork {
 public:
  JointWork(DiagnosisInput const& input, StageSink const& progress)
      : input_(input), progress_(progress), first_look_(input) {
    bool const revolute = input.regressor.joint() == JointKind::revolute;
    joint_.unit_position = revolute ? "rad" : "m";
    joint_.unit_torque = in_torque_unit(revolute ? "N m" : "N", input.train.torque_unit);
    joint_.joint = input.joint;
    joint_.name = input.joint_name;
    diagnosis_.seed = input.seed;
    diagnosis_.q = input.selection.q;
  }

  JointOutcome run() {
    diagnose();
    joint_.verdict = diagnosis_.verdict;
    for (auto const& change : level_changes_) joint_.remarks.push_back(level_change_sentence(joint_, change));
    if (selection_.baseline && !has_reference_)
      joint_.reference_remark = without_reference_sentence(input_.train.reference.size() > 0);
    diagnosis_.joints.push_back(std::move(joint_));
    diagnosis_.reason = whole_reason(diagnosis_);
    return {std::move(diagnosis_), std::move(laws_), std::move(tried_)};
  }

 private:
  void tell(char const* stage, std::size_t done, std::size_t total) const {
    if (progress_) progress_(stage, done, total);
  }

  void hopeless(Hopeless const& why) {
    diagnosis_.verdict = why.verdict;
    diagnosis_.finding = why.finding;
    diagnosis_.way_out = why.way_out;
  }

  void diagnose() {
    Recording recording = without_echoed_reference(from_zero(input_.train));
    has_reference_ = recording.reference.size() > 0;
    // a job that asks for the impossible is refused; a recording that cannot carry it is a verdict
    auto why = verdict_of(Verdict::data_fault, [&] { return first_look_.look(recording); });
    joint_.train_relerr = first_look_.relerr();
    joint_.remarks = first_look_.remarks();
    if (input_.further_training > 0) joint_.remarks.push_back(several_recordings_sentence(training_names(input_)));
    if (!why && input_.validate.empty()) why = first_look_.place_is_time();
    if (why) return hopeless(*why);
    OwnedRecordings others{{}, input_.further_training};
    for (auto const& given : input_.validate)
      others.all.push_back(from_zero(first_look_.less_simulator(without_echoed_reference(given))));
    // an arm's fit has seen the rows of training: what is not known of it shows in none of them
    for (std::size_t i = 0; i < others.training; ++i) others.all[i].load_errors = {};
    JointSearchAnswer answer =
        search_joint({input_, first_look_, has_reference_, levels(), progress_}, recording, others);
    if (!answer.found.too_short.empty()) joint_.remarks.push_back(too_few_rows_sentence(answer.found.too_short));
    if (answer.why) return hopeless(*answer.why);
    found_ = std::move(answer.found);
    selection_ = found_.kept.state.selection;
    tell("verify", 0, selection_.accepted.size());  // which may have made twins
    account_for_models(selection_, timing_remark(found_.torque_late_s, input_.train.rate_hz), joint_);
    joint_.timing_sentence = timing_sentence(found_.torque_late_s, input_.train.rate_hz);
    joint_.candidates = candidate_table(selection_, input_.selection.q, blocked_mismatch(baseline()).excess);
    joint_.map = mismatch_map(baseline().comparison.rows, baseline().reference().scales, input_.threads);
    if (!selection_.accepted.empty()) add_after(joint_.map, final_stage().comparison.rows, input_.threads);
    tell_in_recorded_unit(joint_);
    if (!selection_.accepted.empty()) account_for_effects();
    account_for_unseen();
    if (!found_.search->states.front().adequacy.holds())
      neighbours_ = neighbour_load(*found_.recording, *baseline().pipeline, baseline().comparison.recording);
    budget();
    decide();
    if (!selection_.accepted.empty()) tried_ = law_torques();
    if (!joint_.effects.empty()) laws_ = tried_;
    tell("verify", selection_.accepted.size(), selection_.accepted.size());
  }

  DecisionLevels levels() const {
    DecisionLevels levels = input_.levels;
    levels.alpha = input_.selection.q;
    return levels;
  }

  ModelStage const& final_stage() const { return *selection_.final; }
  ModelStage const& baseline() const { return *selection_.baseline; }

  void account_for_effects() {
    NamedEffects named = name_effects(selection_, *found_.kept.state.evidence, input_.selection.candidates, levels(),
                                      {input_.selection.shape_optimiser, input_.seed, input_.threads, false});
    joint_.effects = std::move(named.effects);
    joint_.augmented = std::move(named.parameters);
    tell_in_recorded_unit(joint_);
    JointScales const& scales = final_stage().model().reference().scales;
    FrictionSign const sign = scales.friction_sign();
    joint_.law_levels = {sign.forward, sign.backward, scales.inertia};
    place_ = std::move(named.place);
  }

  void account_for_unseen() {
    StageSetting const& setting = found_.search->setting;
    HeldOut& held_out = found_.kept.held_out;
    joint_.forward.push_back(simulate_forward(setting.recording, final_stage().twin->loop, baseline(), final_stage(),
                                              {final_stage().model(), final_stage().estimate()}));
    joint_.train_left_out = told(left_out_in_training(setting, baseline(), final_stage()));
    joint_.held_out = {held_out.gain.blocks == 0               ? ""
                       : found_.others.others().unseen.empty() ? "cross-validated"
                                                               : "unseen",
                       held_out.gain.blocks == 0 ? "" : word(held_out.gain.change), held_out.gain.t,
                       held_out.gain.asked_for, held_out.gain.blocks};
    std::vector<double> without(final_stage().model().effects().size(), 0.0);
    for (auto& result : held_out.unseen) {
      for (std::size_t i = 0; i < without.size(); ++i) without[i] += result.by_effect[i].before - result.energies.after;
      joint_.forward.push_back(result.forward);
      auto const& residual = selection_.accepted.empty() ? result.trace.before : result.trace.after;
      if (auto const change = level_change(result.trace, residual, result.memory_rows, levels().least_fall))
        level_changes_.push_back(*change);
      joint_.traces.push_back(std::move(result.trace));
      joint_.nuisances.insert(joint_.nuisances.end(), result.nuisances.begin(), result.nuisances.end());
      unseen_twins_ran_away_ = unseen_twins_ran_away_ || result.twins_ran_away;
    }
    if (found_.others.training > 0) account_for_further_training();
    if (found_.others.others().unseen.empty()) {
      auto const& record = baseline().comparison.recording;
      joint_.traces.push_back(
          torque_trace(setting.recording, *baseline().pipeline, record, record.residual_itself(), residual_after()));
      return;
    }
    joint_.validation_left_out = told(held_out.left_out);
    joint_.validation_torque_energy = held_out.torque;
    joint_.validation_relerr = std::sqrt(held_out.before / held_out.torque);
    joint_.augmented_validation_relerr = std::sqrt(held_out.after / held_out.torque);
    if (double const floor = floor_of(held_out); std::isfinite(floor)) joint_.floor_relerr = floor;
    for (std::size_t i = 0; i < without.size(); ++i) {
      double& gain = joint_.effects[place_[i]].gain.validation;
      gain = (std::isfinite(gain) ? gain : 0.0) + without[i] / held_out.before;
    }
  }

  // one fit to all training recordings, and each of them by the fit to the others
  void account_for_further_training() {
    StageSetting const& setting = found_.search->setting;
    RecordingsInTurn const in_turn = recordings_in_turn(setting, found_.others.others().training, selection_);
    auto const error = [&](double energy) { return std::sqrt(energy / in_turn.torque); };
    double before = 0.0, after = 0.0;
    for (auto const& one : in_turn.recordings) {
      before += one.before.squaredNorm();
      after += one.after.squaredNorm();
    }
    joint_.train_relerr = error(in_turn.fitted_before);
    joint_.augmented_train_relerr = error(in_turn.fitted_after);
    joint_.cv_relerr = error(before);
    joint_.augmented_cv_relerr = error(after);
    for (auto const& recording : found_.others.others().training) joint_.traces.push_back(trace_in_training(recording));
  }

  TorqueTrace trace_in_training(Recording const& recording) const {
    RecordPipeline const plain = pipeline_for(found_.search->setting, recording, baseline());
    RecordPipeline full = pipeline_for(found_.search->setting, recording, final_stage());
    ProcessedRecord const before = plain.prepare(recording);
    full.restrict_to(before.kept_rows);
    ProcessedRecord const after = full.prepare(recording);
    return torque_trace(recording, plain, before, before.torque - before.columns * baseline().estimate(),
                        after.torque - after.columns * transferable(final_stage()));
  }

  // of each name; waves of one kind share theirs
  std::vector<LawTorques> law_torques() const {
    std::vector<LawTorques> laws(*std::max_element(place_.begin(), place_.end()) + 1);
    Eigen::VectorXd const elsewhere = transferable(final_stage());
    add_law_torques(laws, found_.search->setting.recording, final_stage().estimate());
    for (auto const& recording : found_.others.all) add_law_torques(laws, recording, elsewhere);
    return laws;
  }

  void add_law_torques(std::vector<LawTorques>& laws, Recording const& recording,
                       Eigen::VectorXd const& parameters) const {
    RecordPipeline const pipeline = pipeline_for(found_.search->setting, recording, final_stage());
    ProcessedRecord const record = pipeline.prepare(recording);
    Eigen::MatrixXd const columns = pipeline.model().columns(record.motion, record.drive);
    for (auto& law : laws) law.push_back(Eigen::VectorXd::Zero(columns.rows()));
    auto first = static_cast<Eigen::Index>(final_stage().model().regressor().size());
    for (std::size_t i = 0; i < place_.size(); ++i) {
      auto const count = static_cast<Eigen::Index>(final_stage().model().effects()[i].effect->n_linear());
      laws[place_[i]].back() += columns.middleCols(first, count) * parameters.segment(first, count);
      first += count;
    }
  }

  // of the final model, on the rows of the baseline: NaN where it keeps none
  Eigen::VectorXd residual_after() const {
    auto const& rows = baseline().comparison.recording.kept_rows;
    auto const& after = final_stage().comparison.recording;
    Eigen::VectorXd const residual = after.residual_itself();
    Eigen::VectorXd left = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(rows.size()), unknown);
    for (std::size_t i = 0, k = 0; i < rows.size(); ++i) {
      while (k < after.kept_rows.size() && after.kept_rows[k] < rows[i]) ++k;
      if (k < after.kept_rows.size() && after.kept_rows[k] == rows[i])
        left[static_cast<Eigen::Index>(i)] = residual[static_cast<Eigen::Index>(k)];
    }
    return left;
  }

  void budget() {
    double const residual = selection_.first_energy.residual;
    double const excess = std::max(0.0, selection_.first_excess);
    double const mismatch = std::min(1.0, excess / residual);
    double const left = selection_.is_gate_open
                            ? std::clamp(std::max(0.0, final_stage().energy.excess) / selection_.whole(), 0.0, 1.0)
                            : 1.0;
    double const of_model = 1.0 - first_look_.parameter_share();
    // what no gate passed is noise as far as anybody can tell
    joint_.budget.parameter_error = first_look_.parameter_share();
    joint_.budget.missing_physics = of_model * mismatch * (1.0 - left);
    joint_.budget.unexplained = selection_.is_gate_open ? of_model * mismatch * left : 0.0;
    joint_.budget.noise =
        1.0 - joint_.budget.parameter_error - joint_.budget.missing_physics - joint_.budget.unexplained;
  }

  VerdictFacts facts() const {
    VerdictFacts facts;
    facts.is_baseline_adequate = found_.search->states.front().adequacy.holds();
    facts.laws = selection_.accepted.size();
    facts.is_adequate = found_.kept.state.adequacy.holds();
    facts.is_held_out_lower = found_.kept.is_held_out_lower;
    facts.is_worth_naming = found_.kept.fall >= levels().least_fall;
    facts.explains_most = found_.kept.explains_most;
    facts.has_class = std::any_of(joint_.effects.begin(), joint_.effects.end(),
                                  [](NamedEffect const& one) { return !one.equivalent.empty(); });
    facts.all_on_channel =
        !joint_.effects.empty() && std::all_of(joint_.effects.begin(), joint_.effects.end(), is_fault);
    facts.is_motion_poor = blamed_for_silence().has_value();
    facts.others_predict_better = others_predict_better();
    facts.has_relation = !first_look_.limits().has_no_relation || selection_.is_gate_open;
    return facts;
  }

  bool others_predict_better() const {
    if (!neighbours_ || neighbours_->gain.change != HeldOutChange::lower) return false;
    double const least = selection_.accepted.empty() ? joint_.cv_relerr : joint_.augmented_cv_relerr;
    return neighbours_->relerr < std::min(least, (1.0 - levels().least_fall) * joint_.cv_relerr);
  }

  // a motion that could not have shown much, or a noise that hides what is not small
  std::optional<Hopeless> blamed_for_silence() const {
    if (auto why = first_look_.blamed_for_silence()) return why;
    double const visible = visible_share(baseline(), joint_.floor_relerr);
    if (visible < levels().tolerance) return std::nullopt;
    return noise_hides(visible);
  }

  void decide() {
    VerdictOf const decided = verdict_of(facts());
    diagnosis_.verdict = decided.verdict;
    joint_.verdict_reason = word(decided.reason);
    if (decided.reason == VerdictReason::nothing_left) {
      if (!joint_.effects.empty()) withdraw(decided.reason);
      if (auto const why = first_look_.static_torque()) hopeless(*why);
      return;
    }
    if (decided.reason == VerdictReason::too_small) return withdraw(decided.reason);
    if (decided.reason == VerdictReason::motion_poor || decided.reason == VerdictReason::no_relation)
      hopeless(*blamed_for_silence());
    if (decided.reason == VerdictReason::motion_poor) {
      if (!joint_.effects.empty()) withdraw(decided.reason);
      return;
    }
    if (decided.reason == VerdictReason::other_joints)
      joint_.other_joints = other_joints_sentence(joint_, neighbours_->columns, neighbours_->relerr);
    if (!found_.kept.state.adequacy.holds()) {
      auto const& final = final_stage();
      joint_.unexplained = largest_parts(mismatch_map(final.comparison.rows, final.reference().scales, input_.threads));
    } else if (!decided.keeps_names) {
      joint_.unexplained = largest_parts(joint_.map);
    }
    tell_in_recorded_unit(joint_);
    if (!decided.keeps_names) return withdraw(decided.reason);
    ExplainedShare const& explained = found_.kept.held_out.explained;
    joint_.explained_share = explained.share;
    joint_.explained_low = explained.low;
    joint_.explained_high = explained.high;
    mark_equivalent(joint_.candidates, joint_.effects);
    for (auto& effect : joint_.effects) effect.sentence = effect_sentence(joint_, effect);
    if (decided.verdict == Verdict::data_fault) diagnosis_.way_out = way_out_of_a_fault(joint_, true);
    joint_.excitation = advice_for(joint_.effects);
  }

  // nothing that was named stands
  void withdraw(VerdictReason reason) {
    std::string why = "does not make the error on rows it was not fitted to clearly lower";
    if (reason == VerdictReason::not_held_out && !joint_.effects.empty())
      joint_.refutation = refutation_clause(joint_, unseen_twins_ran_away_);
    if (reason == VerdictReason::too_small) {
      joint_.refutation = too_small_clause(joint_);
      why = fmt::format("the error on rows it was not fitted to falls by less than {}",
                        percent_text(levels().least_fall));
    }
    if (reason == VerdictReason::most_is_left) {
      joint_.refutation =
          too_little_clause(joint_, 1.0 - found_.kept.held_out.gain.after / found_.kept.held_out.gain.before);
      why = "it explains less than half";
    }
    if (reason == VerdictReason::other_joints) why = "the motion of other joints predicts better";
    std::vector<std::string> closest;
    for (auto const& effect : joint_.effects) closest.push_back(effect.name);
    joint_.excitation = advice_to_confirm(closest.empty() ? closest_of(joint_.candidates) : closest);
    withdraw_names(joint_.candidates, "withdrawn: " + why);
    joint_.budget.unexplained += joint_.budget.missing_physics;
    joint_.budget.missing_physics = 0.0;
    joint_.effects.clear();
    joint_.augmented.clear();
    joint_.augmented_train_relerr = joint_.augmented_validation_relerr = joint_.augmented_cv_relerr = unknown;
    joint_.train_left_out.augmented_relerr = joint_.validation_left_out.augmented_relerr = unknown;
  }

  DiagnosisInput const& input_;
  StageSink const& progress_;
  FirstLook first_look_;
  Diagnosis diagnosis_;
  JointDiagnosis joint_;
  Selection selection_;
  std::vector<LawTorques> laws_, tried_;
  std::vector<LevelChange> level_changes_{};
  std::vector<std::size_t> place_;  // of each accepted effect among the named ones
  bool has_reference_ = false;      // one that tells a loop
  bool unseen_twins_ran_away_ = false;
  std::optional<NeighbourLoad> neighbours_{};
  SearchedJoint found_{};
};

}  // namespace

std::vector<std::string> training_names(DiagnosisInput const& input) {
  std::vector<std::string> names{input.train.name};
  for (std::size_t i = 0; i < input.further_training; ++i) names.push_back(input.validate[i].name);
  return names;
}

JointOutcome diagnose_joint(DiagnosisInput const& input, StageSink const& progress) {
  return JointWork(input, progress).run();
}

}  // namespace torquescope
