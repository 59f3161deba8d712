#include "engine/infer/decision/joint_decision.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/infer/decision/accepted_model.hpp"
#include "engine/infer/decision/decision_verdict.hpp"
#include "engine/infer/decision/delay_decision.hpp"
#include "engine/infer/decision/effect_trial.hpp"
#include "engine/infer/decision/replicate_gains.hpp"
#include "engine/infer/decision/rivals.hpp"
#include "engine/infer/decision/row_weights.hpp"
#include "engine/infer/decision/smooth_correction.hpp"
#include "engine/infer/decision/sticking_shape.hpp"
#include "engine/simulate/rollout/effective_samples.hpp"

namespace torquescope {
namespace {

// what is known of each question once those that gain most were tried
AskedEffects asked_effects(std::size_t questions, std::vector<TriedEffect> const& tried) {
  std::vector<bool> const no_effect(questions, false);
  AskedEffects asked{std::vector<bool>(questions, true), no_effect, no_effect};
  for (auto const& one : tried) {
    Refusal const refusal = one.facts.refusal;
    asked.open[one.question] = asked.nameable[one.question] = refusal == Refusal::none;
    asked.doubted[one.question] = refusal == Refusal::at_bound || refusal == Refusal::not_predicted;
  }
  return asked;
}

class Search {
 public:
  explicit Search(DecisionQuestion const& question) : q_(question) { result_.rows = joint_strips(question); }

  JointDecision run() && {
    FittedModel plain = plain_model();
    if (q_.weighs_rows) {
      FittedModel const at_own_sizes = without_effects(*plain.fitted);
      result_.rows = weighed_rows(q_, std::move(result_.rows), at_own_sizes);
      plain = plain_model();
    }
    result_.baseline = without_effects(*plain.fitted);
    accepted_.fit = without_effects(*plain.fitted);
    accepted_.judged = errors_of(rows(), accepted_.fit).judged();
    note_rows();
    while (has_room() && has_taken_one()) accepted_ = without_useless(on(), std::move(accepted_), result_.facts.steps);
    finish();
    return std::move(result_);
  }

 private:
  JointStrips const& rows() const { return result_.rows; }
  DecisionContext on() const { return {q_, rows(), result_.baseline.model->reference().scales}; }

  void tell(char const* stage, std::size_t done, std::size_t total) const {
    if (q_.progress) q_.progress(stage, done, total);
  }

  bool has_room() const {
    return accepted_.effects.size() < q_.most_effects && result_.facts.steps.size() < 2 * q_.most_effects + 2;
  }

  FittedModel plain_model() const { return fitted_model(rows(), q_.regressor, {}, nullptr, free_delay(q_.numbers)); }

  FittedModel without_effects(FittedStrips const& sizes) const {
    return fitted_model(rows(), q_.regressor, {}, &sizes, free_delay(q_.numbers));
  }

  void note_rows() {
    double quiet = 0.0, duration = 0.0, kept = 0.0;
    for (auto const& strip : *rows().training) {
      quiet += strip.quiet_share() * strip.duration_s();
      kept += strip.row_share() * strip.duration_s();
      duration += strip.duration_s();
    }
    result_.facts.quiet_share = quiet / duration;
    result_.facts.set_aside_share = std::max(0.0, 1.0 - kept / duration);
    result_.facts.torque_rms = rows().torque_rms();
    result_.facts.sticking_length = sticking_bounds(rows().training->front().resolution).most_length;
  }

  // effects of a clock come after those of the motion, which are asked again beside every new model
  bool has_taken_one() {
    result_.facts.last_steps = 0;
    if (step(false)) return true;
    auto const& steps = result_.facts.steps;
    bool const is_borne = result_.facts.last_steps == 0 || bears_effects_of_clock(steps.back());
    return is_borne && has_room() && step(true);
  }

  // whether an effect was taken
  bool step(bool of_clock) {
    FoldKind const kind = of_clock ? FoldKind::interleaved : FoldKind::whole;
    auto questions = questions_of(on(), effects_to_ask(on(), accepted_, of_clock));
    if (questions.empty() && (of_clock || accepted_.effects.empty()))
      return false;  // a model with effects is still asked for more
    tell("search", 0, questions.size());
    FittedStrips const& recording = *accepted_.fit.fitted;
    Score const score(recording.base(), recording.residual(), recording.guard(), kind);
    auto const findings = scan_recording(questions, recording, score, q_.threads);
    auto const effects = shaped_effects(accepted_);
    TrialModel const beside{rows(), accepted_.fit, effects, score, on().scales, accepted_.judged};
    Eigen::VectorXd const gains = gains_of(findings);
    auto tried = tried_effects(q_, beside, questions, findings, places_of_largest(gains, q_.numbers.refined), kind);
    tell("search", questions.size(), questions.size());
    SmoothCorrections const corrections =
        smooth_corrections(recording, {recording.base(), recording.residual(), recording.guard()});
    ReplicateTask const task{accepted_.fit,
                             left_beside_effect(tried),
                             gains,
                             asked_effects(questions.size(), tried),
                             corrections,
                             kind,
                             static_cast<std::uint32_t>(result_.facts.steps.size())};
    ReplicateGains const null = replicate_gains(q_, task, questions);
    if (null.chance.replicates() < 2) return false;  // no model that could be followed
    add_those_beyond_chance(tried, beside, questions, findings, null.chance, kind);
    chance_of_delay_.insert(chance_of_delay_.end(), null.delays.begin(), null.delays.end());
    if (result_.facts.steps.empty()) result_.baseline_replicates = null.left;
    result_.final_replicates = null.left;
    StepFacts facts{{},
                    null.chance.replicates(),
                    null.source,
                    of_clock,
                    false,
                    visible_share(null, score),
                    std::sqrt(recording.chosen().fit.energy() / rows().training_energy),
                    correction_facts(corrections, null.corrections)};
    facts.effects = effect_facts(questions, findings, tried, null.chance);
    facts.has_taken = take_first(facts.effects, tried);
    result_.facts.last_steps = facts.has_taken ? 0 : result_.facts.last_steps + 1;
    result_.facts.steps.push_back(std::move(facts));
    return result_.facts.steps.back().has_taken;
  }

  // Effects that gain less than others, but more beyond what chance does for them. Among all, largest D first
  void add_those_beyond_chance(std::vector<TriedEffect>& tried, TrialModel const& beside,
                               std::vector<EffectQuestion> const& questions, std::vector<EffectFinding> const& findings,
                               Chance const& chance, FoldKind kind) const {
    Eigen::VectorXd const gains = gains_of(findings), relative = chance.relative(gains), p = chance.p(gains);
    std::vector<std::size_t> further = places_of_largest(relative, q_.numbers.refined);
    std::erase_if(further, [&](std::size_t effect) {
      return p[static_cast<Eigen::Index>(effect)] > q_.numbers.alpha ||
             std::any_of(tried.begin(), tried.end(), [&](TriedEffect const& one) { return one.question == effect; });
    });
    for (auto& one : tried_effects(q_, beside, questions, findings, further, kind)) tried.push_back(std::move(one));
    std::stable_sort(tried.begin(), tried.end(),
                     [](TriedEffect const& a, TriedEffect const& b) { return a.facts.gain > b.facts.gain; });
  }

  // what the model leaves beside the effect that gains most and that nothing speaks against
  Eigen::VectorXd const& left_beside_effect(std::vector<TriedEffect> const& tried) const {
    auto const first =
        std::find_if(tried.begin(), tried.end(), [](auto const& one) { return one.facts.refusal == Refusal::none; });
    return first == tried.end() ? accepted_.fit.fitted->residual() : first->with.fitted->residual();
  }

  // of all effects, largest T first
  std::vector<EffectFacts> effect_facts(std::vector<EffectQuestion> const& questions,
                                        std::vector<EffectFinding> const& findings,
                                        std::vector<TriedEffect> const& tried, Chance const& chance) const {
    Eigen::VectorXd const p = chance.p(gains_of(findings)), level = chance.level(q_.numbers.alpha);
    std::vector<EffectFacts> effects;
    for (std::size_t const i : places_of_largest(chance.relative(gains_of(findings)))) {
      auto const at = static_cast<Eigen::Index>(i);
      auto const own = std::find_if(tried.begin(), tried.end(), [&](auto const& one) { return one.question == i; });
      EffectFacts facts =
          own != tried.end()
              ? own->facts
              : EffectFacts{questions[i].effect, questions[i].grid.point(findings[i].point), findings[i].gain};
      facts.p = p[at];
      facts.level = level[at];
      if (own == tried.end() || facts.refusal == Refusal::none) facts.refusal = Refusal::smaller;
      if (facts.p > q_.numbers.alpha) facts.refusal = Refusal::chance;
      effects.push_back(std::move(facts));
    }
    return effects;
  }

  // the one that gains most and that nothing speaks against
  bool take_first(std::vector<EffectFacts>& effects, std::vector<TriedEffect>& tried) {
    for (auto& one : tried) {
      auto const effect = std::find_if(effects.begin(), effects.end(),
                                       [&](auto const& facts) { return facts.effect == one.facts.effect; });
      if (one.facts.refusal != Refusal::none || effect->p > q_.numbers.alpha) continue;
      effect->refusal = Refusal::none;
      // once more, with the loads and levels that the joint has beside the effect: without it they are bent
      accepted_ = with_effect(on(), std::move(accepted_), *effect, *one.with.fitted);
      return true;
    }
    return false;
  }

  // the one least likely by chance; of several, the one of most torque
  CorrectionFacts correction_facts(SmoothCorrections const& of_recording, Chance const& chance) const {
    Eigen::VectorXd const p = chance.p(of_recording.gains);
    Eigen::Index best = 0;
    for (Eigen::Index i = 1; i < p.size(); ++i)
      if (p[i] < p[best] || (p[i] == p[best] && of_recording.rms[i] > of_recording.rms[best])) best = i;
    return {of_recording.axes[static_cast<std::size_t>(best)], of_recording.gains[best], p[best],
            of_recording.rms[best] / rows().torque_rms()};
  }

  // the torque of an effect of which as many effects as not would come out: S_0 falls by D / n_eff in its logarithm
  // Where no effect is left, smooth functions tell
  double visible_share(ReplicateGains const& null, Score const& score) const {
    Eigen::VectorXd needed = null.chance.gains.rows() > 0 ? null.chance.needed(q_.numbers.alpha)
                                                          : null.corrections.needed(q_.numbers.correction_alpha());
    std::nth_element(needed.begin(), needed.begin() + needed.size() / 2, needed.end());
    Eigen::VectorXd const left = score.left_on_rows_with({}, 0);
    double const fall = std::expm1(needed[needed.size() / 2] / effective_samples(left));
    return std::sqrt(fall * left.squaredNorm() / rows().training_energy);
  }

  std::span<StepFacts const> last_steps() const {
    return std::span(result_.facts.steps).last(result_.facts.last_steps);
  }

  void finish() {
    DecisionFacts& facts = result_.facts;
    facts.is_complete = is_complete(last_steps(), q_.numbers);
    if (!facts.is_complete) accepted_ = without_effects_of_clock(on(), std::move(accepted_));
    // from the last one on: an effect that another stands for goes to the end
    for (std::size_t i = accepted_.effects.size(); i-- > 0;)
      accepted_ = with_rivals(on(), std::move(accepted_), i, facts.steps);
    // what made up for an effect that another stands for now
    accepted_ = without_useless(on(), std::move(accepted_), facts.steps);
    facts.accepted = std::move(accepted_.effects);
    result_.final = std::move(accepted_.fit);
    facts.delay = decided_delay(q_, rows(), result_.final, chance_of_delay_);
    facts.weighed_final = errors_of(rows(), result_.final);
    bool const is_more_than_is_left = facts.delay.size > facts.weighed_final.train;
    facts.delay.is_named = facts.delay.is_named && (facts.is_complete || is_more_than_is_left);
    facts.parameters = numbers_of(result_.final);
    facts.baseline_late_s = result_.baseline.fitted->chosen().late_s;
    facts.baseline_parameters = numbers_of(result_.baseline);
    // a delay that is named is a part of what the names explain
    if (facts.delay.is_named) result_.baseline = at_allowed_delay(rows(), result_.baseline);
    facts.weighed_baseline = errors_of(rows(), result_.baseline);
    count_all_rows_alike();
    facts.baseline = errors_of(rows(), result_.baseline);
    facts.final = errors_of(rows(), result_.final);
    facts.delay.judged_without = errors_of(rows(), at_allowed_delay(rows(), result_.final)).judged();
  }

  // what is told of the models is told of all rows alike
  void count_all_rows_alike() {
    if (!q_.weighs_rows) return;
    for (auto* left : {&result_.baseline_replicates, &result_.final_replicates})
      if (auto const& weight = rows().training->front().row_weight; weight.size() == left->rows())
        *left = weight.cwiseInverse().asDiagonal() * *left;
    result_.rows = unweighed_rows(std::move(result_.rows));
    result_.baseline = fitted_alike(rows(), result_.baseline);
    result_.final = fitted_alike(rows(), result_.final);
  }

  DecisionQuestion const& q_;
  AcceptedModel accepted_{};
  std::vector<double> chance_of_delay_{};
  JointDecision result_{};
};

}  // namespace

JointDecision decide_joint(DecisionQuestion const& question) { return Search(question).run(); }

}  // namespace torquescope
