#include "engine/diagnose/joint_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "engine/account/arm_sentences.hpp"
#include "engine/account/error_words.hpp"
#include "engine/account/excitation_advice.hpp"
#include "engine/account/power_words.hpp"
#include "engine/account/sentences.hpp"
#include "engine/account/withdrawn_names.hpp"
#include "engine/base/contract.hpp"
#include "engine/base/torque_unit.hpp"
#include "engine/data/from_zero.hpp"
#include "engine/diagnose/decision_account.hpp"
#include "engine/diagnose/effect_names.hpp"
#include "engine/diagnose/first_look.hpp"
#include "engine/diagnose/loop_names.hpp"
#include "engine/diagnose/neighbour_load.hpp"
#include "engine/diagnose/recorded_unit.hpp"
#include "engine/diagnose/strip_account.hpp"
#include "engine/effects/carry_over.hpp"
#include "engine/fit/statistics/block_jackknife.hpp"
#include "engine/infer/decision/decision_verdict.hpp"
#include "engine/infer/decision/decision_words.hpp"
#include "engine/infer/decision/delay_decision.hpp"
#include "engine/infer/decision/joint_decision.hpp"
#include "engine/infer/decision/loop_stage.hpp"
#include "engine/infer/decision/names_on_rows.hpp"
#include "engine/infer/locate/largest_parts.hpp"
#include "engine/infer/locate/mismatch_map.hpp"
#include "engine/infer/pipeline/echoed_reference.hpp"

namespace torquescope {
namespace {

// so many that chance below alpha can be counted
std::int64_t replicates_for(DecisionNumbers const& numbers) {
  return std::max(numbers.replicates, static_cast<std::int64_t>(std::ceil(1.0 / numbers.correction_alpha() - 1e-9)));
}

// what the table of candidates says of names, and of effects that some name could be as well
void mark_candidates(std::vector<Candidate>& candidates, std::vector<NamedEffect> const& effects) {
  for (auto& candidate : candidates) {
    bool const was_named = candidate.decision == Decision::named;
    if (was_named) candidate.decision = Decision::rejected;
    for (auto const& effect : effects) {
      if (candidate.name == effect.name) {
        candidate.decision = Decision::named;
        candidate.reason.clear();
      } else if (std::find(effect.equivalent.begin(), effect.equivalent.end(), candidate.name) !=
                 effect.equivalent.end()) {
        candidate.decision = Decision::equivalent;
        candidate.reason = "this motion cannot tell it from " + effect.name;
      }
    }
    if (was_named && candidate.decision == Decision::rejected) candidate.reason = "the final model does without it";
  }
}

class JointWork {
 public:
  JointWork(DiagnosisInput const& input, StageSink const& progress, DecisionSink const& further)
      : input_(input), progress_(progress), further_(further), first_look_(input) {
    bool const revolute = input.regressor.joint() == JointKind::revolute;
    joint_.unit_position = revolute ? "rad" : "m";
    joint_.unit_torque = in_torque_unit(revolute ? "N m" : "N", input.train.torque_unit);
    joint_.joint = input.joint;
    joint_.name = input.joint_name;
    diagnosis_.seed = input.seed;
    diagnosis_.q = input.numbers.alpha;
  }

  Diagnosis run() && {
    decide();
    joint_.verdict = diagnosis_.verdict;
    diagnosis_.joints.push_back(std::move(joint_));
    diagnosis_.reason = whole_reason(diagnosis_);
    return std::move(diagnosis_);
  }

 private:
  void hopeless(Hopeless const& why) {
    diagnosis_.verdict = why.verdict;
    diagnosis_.finding = why.finding;
    diagnosis_.way_out = why.way_out;
  }

  void decide() {
    std::vector<Recording> training{without_echoed_reference(from_zero(input_.train))}, validation;
    auto why = verdict_of(Verdict::data_fault, [&] { return first_look_.look(training.front()); });
    joint_.remarks = first_look_.remarks();
    if (input_.further_training > 0) joint_.remarks.push_back(several_recordings_sentence(training_names(input_)));
    if (!why && input_.validate.empty()) why = first_look_.place_is_time();
    if (why) return hopeless(*why);
    for (std::size_t i = 0; i < input_.validate.size(); ++i) {
      Recording other = from_zero(first_look_.less_simulator(without_echoed_reference(input_.validate[i])));
      (i < input_.further_training ? training : validation).push_back(std::move(other));
    }
    DecisionQuestion question{training, validation, first_look_.regressor(), input_.filter, input_.filter_section};
    question.effects = input_.candidates;
    std::erase_if(question.effects, [&](Effect const* effect) {
      bool const is_unknown =
          effect->is_given() && !(training.front().given && training.front().given->of(effect->name()));
      return is_unknown || closes(first_look_.limits(), *effect);
    });
    question.most_effects = input_.max_effects;
    question.numbers = input_.numbers;
    question.numbers.replicates = replicates_for(input_.numbers);
    question.weighs_rows = !further_;  // an arm pools the rows of its joints
    question.seed = input_.seed;
    question.threads = input_.threads;
    question.progress = [&](char const* stage, std::size_t done, std::size_t total) {
      if (progress_) progress_(stage, done, total);
    };
    why = verdict_of(Verdict::insufficient, [&]() -> std::optional<Hopeless> {
      JointDecision const decision = decide_joint(question);
      LoopFacts const loop = further_ ? LoopFacts{} : decide_in_loop(question, decision, input_.loop);
      tell(decision, loop, question);
      joint_.decision = account_of(decision.facts, question.numbers, word(diagnosis_.verdict));
      joint_.decision->loop = account_of(loop);
      // of an arm all joints decide together
      if (!further_) joint_.power_sentence = power_sentence(*joint_.decision, joint_.unit_position);
      if (further_) further_(decision);
      return std::nullopt;
    });
    if (why) hopeless(*why);
  }

  // one joint of a moving arm: its neighbours' motion says more of the torque than any effect of its own
  bool others_load_it(Recording const& training, DecisionFacts const& facts) {
    if (training.other_positions.cols() == 0) return false;
    JointModel model(first_look_.regressor());
    model.load_as_in(training);
    RecordPipeline const pipeline(std::move(model), input_.filter, training.rate_hz, training.position.size(),
                                  input_.filter_section);
    auto const load = neighbour_load(training, pipeline, pipeline.process(training));
    if (!load || load->gain.change != HeldOutChange::lower) return false;
    double const least = std::min(facts.final.held_out, (1.0 - input_.numbers.least_fall) * facts.baseline.held_out);
    if (!(load->relerr < least)) return false;
    joint_.other_joints = other_joints_sentence(joint_, load->columns, load->relerr);
    return true;
  }

  // what the recording is to blame for where nothing is named
  void nothing_named(DecisionFacts const& facts) {
    auto const blamed = first_look_.blamed_for_silence();
    if (diagnosis_.verdict == Verdict::unexplained) {
      if (first_look_.limits().has_no_relation && blamed) hopeless(*blamed);
      return;
    }
    if (auto const why = first_look_.static_torque()) return hopeless(*why);
    if (blamed) return hopeless(*blamed);
    if (diagnosis_.verdict == Verdict::insufficient) hopeless(noise_hides(facts.steps.front().visible));
  }

  void tell(JointDecision const& decision, LoopFacts const& loop, DecisionQuestion const& question) {
    DecisionFacts const& facts = decision.facts;
    joint_.train_relerr = facts.baseline.train;
    joint_.cv_relerr = facts.baseline.held_out;
    joint_.validation_relerr = facts.baseline.validation;
    joint_.replicates = facts.steps.empty() ? 0 : facts.steps.front().replicates;
    joint_.baseline = estimates_of(*decision.baseline.model, facts.baseline_parameters);
    tell_candidates(facts);
    DecisionOutcome of;
    of.neighbours_predict = others_load_it(question.training.front(), facts);
    // what the rows show beyond chance is there, whether or not its name stands in the loop: unless that is chance
    DecisionFacts const judged = judged_in_loop(facts, loop);
    of.was_adequate = was_adequate(judged, input_.numbers) && !facts.delay.is_named;
    StandingNames const names = standing_names(facts, loop);
    of.has_names = names.any();
    of.is_lower = is_lower(facts, loop, input_.numbers.least_fall);
    of.is_complete = is_complete(std::span(judged.steps).last(judged.last_steps), input_.numbers);
    of.can_tell_little = !facts.steps.empty() && facts.steps.front().could_hide(input_.numbers.tolerance);
    if (!of.neighbours_predict && of.has_names && of.is_lower) {
      tell_errors_with_names(facts.final);
      tell_effects(decision);
      keep_standing(joint_, facts, loop, names);
      if (names.of_other_model)
        if (auto const errors = errors_of_names(question, decision, loop, names)) {
          tell_errors_with_names(*errors);
          bool const lack_one = names.drops_effects && leave_more(*errors, facts.final, input_.numbers.least_fall);
          of.is_complete = of.is_complete && !lack_one;
        }
      if (names.command_delay && !facts.delay.is_named) tell_errors_with_delay(facts);
      // a torque that comes after its motion is no physics, whatever else is named beside it
      bool const comes_after = facts.delay.is_named && facts.delay.late_s > 0.0;
      bool const all_are = std::all_of(joint_.effects.begin(), joint_.effects.end(), is_fault);
      of.all_on_channel = comes_after || all_are;
      of.has_class = std::any_of(joint_.effects.begin(), joint_.effects.end(),
                                 [](NamedEffect const& one) { return !one.equivalent.empty(); });
    }
    mark_candidates(joint_.candidates, joint_.effects);
    diagnosis_.verdict = verdict_from(of);
    tell_timing(decision);
    tell_refitted(question);
    draw(decision, question);
    if (joint_.effects.empty() && !of.neighbours_predict) nothing_named(facts);
    if (diagnosis_.verdict == Verdict::data_fault && !joint_.effects.empty())
      diagnosis_.way_out = way_out_of_a_fault(joint_, of.is_complete);
  }

  void tell_errors_with_names(ModelErrors const& errors) {
    joint_.augmented_train_relerr = errors.train;
    joint_.augmented_cv_relerr = errors.held_out;
    joint_.augmented_validation_relerr = errors.validation;
  }

  // the delay between command and motor shows in the rows as one of the torque
  void tell_errors_with_delay(DecisionFacts const& facts) {
    bool const predicts = facts.final.validation == facts.final.validation;
    (predicts ? joint_.validation_relerr : joint_.cv_relerr) = facts.delay.judged_without;
    (predicts ? joint_.augmented_validation_relerr : joint_.augmented_cv_relerr) = facts.final.judged();
  }

  void tell_candidates(DecisionFacts const& facts) {
    if (facts.steps.empty()) return;
    for (auto const& effect : facts.steps.front().effects) {
      Candidate candidate;
      candidate.name = effect.effect->name();
      candidate.family = word(effect.effect->family());
      candidate.z = std::sqrt(effect.gain);
      candidate.p = candidate.q = effect.p;
      candidate.reason = clause(effect.refusal);
      candidate.decision = effect.refusal == Refusal::none ? Decision::named : Decision::rejected;
      joint_.candidates.push_back(std::move(candidate));
    }
  }

  // within what a recording can tell of when its samples were taken: no name, but a number that people need
  void tell_timing(JointDecision const& decision) {
    DelayFacts const& delay = decision.facts.delay;
    bool const is_clear = std::abs(delay.late_s) > jackknife_quantile * delay.deviation_s;
    if (!is_clear || delay.is_named || allowed_delay(*decision.final.fitted) != delay.late_s) return;
    joint_.timing_sentence = timing_sentence(delay.late_s, input_.train.rate_hz);
  }

  // what the error of recordings to predict is no prediction of (own_clock.hpp)
  void tell_refitted(DecisionQuestion const& question) {
    if (question.validation.empty()) return;
    for (auto const& effect : joint_.effects) {
      Effect const* const known = find_effect(effect.name);
      if (known != nullptr && is_clock_bound(*known)) joint_.nuisances.push_back(refitted_clause(effect.name));
    }
  }

  void draw(JointDecision const& decision, DecisionQuestion const& question) {
    joint_.map = map_of(decision, input_.threads);
    joint_.traces = traces_of(decision, question);
    joint_.budget = budget_of(decision, first_look_.parameter_share());
    tell_mismatch(decision);
    if (joint_.effects.empty()) {
      joint_.budget.unexplained += joint_.budget.missing_physics;
      joint_.budget.missing_physics = 0.0;
    }
    bool const is_left = diagnosis_.verdict == Verdict::partly || diagnosis_.verdict == Verdict::unexplained;
    if (is_left && decision.final_replicates.cols() > 0)
      joint_.unexplained = largest_parts(mismatch_map(mismatch_rows(decision.final, decision.final_replicates),
                                                      decision.baseline.model->reference().scales, input_.threads));
    tell_in_recorded_unit(joint_);
    std::vector<std::string> closest;
    for (auto const& effect : joint_.effects) closest.push_back(effect.name);
    if (!closest.empty())
      joint_.excitation = advice_for(joint_.effects);
    else if (diagnosis_.verdict == Verdict::unexplained)
      joint_.excitation = advice_to_confirm(closest_of(joint_.candidates));
  }

  // torque that replicates do not leave
  void tell_mismatch(JointDecision const& decision) {
    auto const& steps = decision.facts.steps;
    if (steps.empty() || decision.baseline_replicates.cols() == 0) return;
    auto const beyond = [](FittedModel const& by, Eigen::MatrixXd const& replicates) {
      double const energy = by.fitted->residual().head(replicates.rows()).squaredNorm();
      double const chance = replicates.colwise().squaredNorm().mean();
      return std::sqrt(std::max(0.0, energy - chance) / static_cast<double>(replicates.rows()));
    };
    joint_.replicate_energy = energies_of(decision.baseline, decision.baseline_replicates);
    joint_.omnibus_p = steps.front().correction.p;
    joint_.mismatch_rms = beyond(decision.baseline, decision.baseline_replicates);
    joint_.left_rms = beyond(decision.final, decision.final_replicates);
  }

  void tell_effects(JointDecision const& decision) {
    auto const scales = decision.final.model->reference().scales;
    FrictionSign const sign = scales.friction_sign();
    joint_.effect_levels = {sign.forward, sign.backward, scales.inertia};
    EffectNames names = names_of_scan(decision);
    joint_.effects = std::move(names.effects);
    joint_.augmented = std::move(names.parameters);
    tell_in_recorded_unit(joint_);
    for (auto& effect : joint_.effects) effect.sentence = effect_sentence(joint_, effect);
  }

  DiagnosisInput const& input_;
  StageSink const& progress_;
  DecisionSink const& further_;
  FirstLook first_look_;
  Diagnosis diagnosis_{};
  JointDiagnosis joint_{};
};

}  // namespace

std::vector<std::string> training_names(DiagnosisInput const& input) {
  std::vector<std::string> names{input.train.name};
  for (std::size_t i = 0; i < input.further_training; ++i) names.push_back(input.validate[i].name);
  return names;
}

Diagnosis diagnose_joint(DiagnosisInput const& input, StageSink const& progress, DecisionSink const& further) {
  return JointWork(input, progress, further).run();
}

}  // namespace torquescope
