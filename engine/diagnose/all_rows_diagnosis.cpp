#include "engine/diagnose/all_rows_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/decision/decision_words.hpp"
#include "engine/decision/joint_decision.hpp"
#include "engine/decision/loop_stage.hpp"
#include "engine/diagnose/decision_account.hpp"
#include "engine/diagnose/first_look.hpp"
#include "engine/diagnose/loop_names.hpp"
#include "engine/diagnose/neighbour_load.hpp"
#include "engine/statistics/block_jackknife.hpp"
#include "engine/twin/echoed_reference.hpp"
#include "engine/unseen/unseen_record.hpp"
#include "engine/words/sentences.hpp"
#include "engine/words/withdrawn_names.hpp"

namespace torquescope {
namespace {

ParameterEstimate estimate(std::string name, std::string unit, FittedNumber const& number) {
  double const width = jackknife_quantile * number.deviation;
  return {std::move(name), std::move(unit), number.value, number.value - width, number.value + width};
}

class AllRowsWork {
 public:
  AllRowsWork(DiagnosisInput const& input, StageSink const& progress)
      : input_(input), progress_(progress), first_look_(input) {
    bool const revolute = input.regressor.joint() == JointKind::revolute;
    joint_.unit_position = revolute ? "rad" : "m";
    joint_.unit_torque = revolute ? "N m" : "N";
    joint_.joint = input.joint;
    joint_.name = input.joint_name;
    joint_.rows = "all";
    diagnosis_.seed = input.seed;
    diagnosis_.q = input.selection.q;
  }

  JointOutcome run() && {
    decide();
    joint_.verdict = diagnosis_.verdict;
    diagnosis_.joints.push_back(std::move(joint_));
    diagnosis_.reason = whole_reason(diagnosis_);
    return {std::move(diagnosis_), {}, {}};
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
    if (!why && input_.validate.empty()) why = first_look_.place_is_time();
    if (why) return hopeless(*why);
    for (std::size_t i = 0; i < input_.validate.size(); ++i) {
      Recording other = from_zero(first_look_.less_simulator(without_echoed_reference(input_.validate[i])));
      (i < input_.further_training ? training : validation).push_back(std::move(other));
    }
    DecisionQuestion question{training, validation, first_look_.regressor(), input_.filter, input_.filter_section};
    question.laws = input_.selection.candidates;
    std::erase_if(question.laws, [&](Effect const* law) {
      bool const is_unknown = law->is_given() && !(training.front().given && training.front().given->of(law->name()));
      return is_unknown || closes(first_look_.limits(), *law);
    });
    question.most_laws = input_.selection.max_effects;
    question.numbers.alpha = input_.selection.q;
    question.numbers.delta = input_.levels.delta;
    question.numbers.least_fall = input_.levels.least_fall;
    question.seed = input_.seed;
    question.threads = input_.threads;
    question.progress = [&](char const* stage, std::size_t done, std::size_t total) {
      if (progress_) progress_(stage, done, total);
    };
    why = verdict_of(Verdict::insufficient, [&]() -> std::optional<Hopeless> {
      JointDecision const decision = decide_joint(question);
      LoopFacts const loop = decide_in_loop(question, decision, input_.loop);
      tell(decision, loop, training.front());
      joint_.decision = account_of(decision.facts, word(diagnosis_.verdict));
      joint_.decision->loop = account_of(loop);
      return std::nullopt;
    });
    if (why) hopeless(*why);
  }

  // whether replicates of the model that a step began with leave as little as the recording
  bool is_adequate(StepFacts const& step) const {
    double const delta = input_.levels.delta, alpha = input_.selection.q;
    if (step.correction.p <= alpha && step.correction.size >= delta) return false;
    return std::none_of(step.laws.begin(), step.laws.end(), [&](LawFacts const& law) {
      return law.p <= alpha && law.refusal != Refusal::too_small && law.refusal != Refusal::smaller;
    });
  }

  // one joint of a moving arm: its neighbours' motion says more of the torque than any law of its own
  bool others_load_it(Recording const& training, DecisionFacts const& facts) {
    if (training.other_positions.cols() == 0) return false;
    JointModel model(first_look_.regressor());
    model.load_as_in(training);
    RecordPipeline const pipeline(std::move(model), input_.filter, training.rate_hz, training.position.size(),
                                  input_.filter_section);
    auto const load = neighbour_load(training, pipeline, pipeline.process(training));
    if (!load || load->gain.change != HeldOutChange::lower) return false;
    double const least = std::min(facts.final.held_out, (1.0 - input_.levels.least_fall) * facts.baseline.held_out);
    if (!(load->relerr < least)) return false;
    diagnosis_.verdict = Verdict::unexplained;
    joint_.other_joints = other_joints_sentence(joint_, load->columns, load->relerr);
    return true;
  }

  void nothing_named(DecisionFacts const& facts, bool was_adequate) {
    auto const blamed = first_look_.blamed_for_silence();
    if (!was_adequate) {
      diagnosis_.verdict = Verdict::unexplained;
      if (first_look_.limits().has_no_relation && blamed) hopeless(*blamed);
      return;
    }
    diagnosis_.verdict = Verdict::none;
    if (auto const why = first_look_.static_torque()) return hopeless(*why);
    if (blamed) return hopeless(*blamed);
    if (!facts.steps.empty() && facts.steps.front().visible > input_.levels.tolerance)
      hopeless(noise_hides(facts.steps.front().visible));
  }

  void tell(JointDecision const& decision, LoopFacts const& loop, Recording const& training) {
    DecisionFacts const& facts = decision.facts;
    joint_.train_relerr = facts.baseline.train;
    joint_.cv_relerr = facts.baseline.held_out;
    joint_.validation_relerr = facts.baseline.validation;
    joint_.twins = facts.steps.empty() ? 0 : facts.steps.front().replicates;
    tell_parameters(joint_.baseline, decision.baseline, facts.baseline_parameters);
    tell_candidates(facts);
    StandingNames const names = standing_names(facts, loop);
    bool const was_adequate = facts.steps.empty() || (is_adequate(facts.steps.front()) && facts.accepted.empty());
    if (others_load_it(training, facts)) return;
    if (!names.any() || !is_lower(facts, loop, input_.levels.least_fall)) return nothing_named(facts, was_adequate);
    joint_.augmented_train_relerr = facts.final.train;
    joint_.augmented_cv_relerr = facts.final.held_out;
    joint_.augmented_validation_relerr = facts.final.validation;
    tell_effects(decision);
    keep_standing(joint_, facts, loop, names);
    bool const is_complete = has_command_name(loop) || facts.steps.empty() || is_adequate(facts.steps.back());
    // a torque that comes before its motion is a command that the drive follows late: no fault of a channel
    bool const follows_command = facts.delay.is_named && facts.delay.late_s < 0.0;
    bool const all_on_channel = !follows_command && std::all_of(joint_.effects.begin(), joint_.effects.end(), is_fault);
    bool const has_class = std::any_of(joint_.effects.begin(), joint_.effects.end(),
                                       [](NamedEffect const& one) { return !one.equivalent.empty(); });
    diagnosis_.verdict = !is_complete     ? Verdict::partly
                         : all_on_channel ? Verdict::data_fault
                         : has_class      ? Verdict::one_of_class
                                          : Verdict::named;
  }

  void tell_parameters(std::vector<ParameterEstimate>& into, FittedModel const& by,
                       std::vector<FittedNumber> const& numbers) const {
    auto const owners = by.model->column_owners();
    for (std::size_t k = 0; k < owners.size(); ++k)
      into.push_back(estimate(owners[k].name, owners[k].unit, numbers[k]));
  }

  void tell_candidates(DecisionFacts const& facts) {
    if (facts.steps.empty()) return;
    for (auto const& law : facts.steps.front().laws) {
      Candidate candidate;
      candidate.name = law.effect->name();
      candidate.family = word(law.effect->family());
      candidate.z = std::sqrt(law.gain);
      candidate.p = candidate.q = law.p;
      candidate.reason = word(law.refusal);
      candidate.decision = law.refusal == Refusal::none ? Decision::named : Decision::rejected;
      joint_.candidates.push_back(std::move(candidate));
    }
  }

  void tell_effects(JointDecision const& decision) {
    DecisionFacts const& facts = decision.facts;
    JointModel const& model = *decision.final.model;
    JointKind const kind = model.regressor().joint();
    auto const& numbers = facts.parameters;
    for (std::size_t k = 0; k < model.regressor().size(); ++k) {
      auto const& owner = model.regressor().column_owners()[k];
      joint_.augmented.push_back(estimate(owner.name, owner.unit, numbers[k]));
    }
    std::size_t shape_at = model.size();
    for (std::size_t i = 0; i < facts.accepted.size(); ++i) {
      LawFacts const& law = facts.accepted[i];
      NamedEffect named = named_after(*law.effect);
      named.p = named.q = law.p;
      named.z = std::sqrt(law.gain);
      named.rms = law.size * facts.torque_rms;
      for (auto const* rival : law.rivals) named.equivalent.push_back(rival->name());
      auto const& parameters = law.effect->parameters();
      for (std::size_t k = 0; k < parameters.size(); ++k) {
        bool const is_shape = parameters[k].is_shape;
        std::size_t const at = is_shape ? shape_at++ : model.first_parameter(i) + k;
        FittedNumber const number =
            at < numbers.size() ? numbers[at] : FittedNumber{law.shape[k - law.effect->n_linear()], unknown};
        named.parameters.push_back(estimate(parameters[k].name, parameters[k].unit_for(kind), number));
      }
      joint_.effects.push_back(std::move(named));
    }
    if (facts.delay.is_named) tell_delay(facts.delay);
  }

  void tell_delay(DelayFacts const& delay) {
    auto const timing = std::find_if(effect_choices().begin(), effect_choices().end(),
                                     [](Effect const* one) { return one->is_torque_timing(); });
    if (timing == effect_choices().end()) return;
    NamedEffect named = named_after(**timing);
    named.p = named.q = least_p(joint_.twins);
    named.z = std::sqrt(delay.gain);
    named.parameters.push_back(estimate(named.name, "s", {delay.late_s, delay.deviation_s}));
    joint_.effects.push_back(std::move(named));
  }

  DiagnosisInput const& input_;
  StageSink const& progress_;
  FirstLook first_look_;
  Diagnosis diagnosis_{};
  JointDiagnosis joint_{};
};

}  // namespace

std::vector<std::string> decider_words() { return {"moving_rows", "all_rows", "both"}; }

Decider decider_of(std::string const& word) {
  TORQUESCOPE_EXPECT(word == "moving_rows" || word == "all_rows" || word == "both");
  if (word == "both") return Decider::both;
  return word == "all_rows" ? Decider::all_rows : Decider::moving_rows;
}

JointOutcome diagnose_on_all_rows(DiagnosisInput const& input, StageSink const& progress) {
  return AllRowsWork(input, progress).run();
}

}  // namespace torquescope
