#include "engine/infer/decision/joint_decision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "engine/effects/carry_over.hpp"
#include "engine/infer/decision/decision_verdict.hpp"
#include "engine/infer/decision/delay_decision.hpp"
#include "engine/infer/decision/effect_trial.hpp"
#include "engine/infer/decision/replicate_gains.hpp"
#include "engine/infer/decision/row_weights.hpp"
#include "engine/infer/decision/shape_fit.hpp"
#include "engine/infer/decision/smooth_correction.hpp"
#include "engine/infer/decision/sticking_shape.hpp"
#include "engine/simulate/rollout/effective_samples.hpp"

namespace torquescope {
namespace {

// the first so many
std::vector<std::size_t> first_of(std::vector<std::size_t> order, std::size_t count) {
  order.resize(std::min(count, order.size()));
  return order;
}

FoldKind folds_of(Effect const& effect) { return is_clock_bound(effect) ? FoldKind::interleaved : FoldKind::whole; }

class Search {
 public:
  explicit Search(DecisionQuestion const& question) : q_(question) { result_.rows = joint_strips(question); }

  JointDecision run() && {
    FittedModel plain = fitted_model(result_.rows, q_.regressor, {}, nullptr, free_delay());
    if (q_.weighs_rows) {
      FittedModel const at_own_sizes = fitted_with({}, *plain.fitted);
      result_.rows = weighed_rows(q_, std::move(result_.rows), at_own_sizes);
      plain = fitted_model(result_.rows, q_.regressor, {}, nullptr, free_delay());
    }
    result_.baseline = fitted_with({}, *plain.fitted);
    result_.final = fitted_with({}, *plain.fitted);
    judged_ = errors_of(rows(), result_.final).judged();
    note_rows();
    while (has_room() && has_taken_one()) drop_useless();
    finish();
    return std::move(result_);
  }

 private:
  JointStrips const& rows() const { return result_.rows; }
  JointScales const& scales() const { return result_.baseline.model->reference().scales; }
  DelayChoice free_delay() const { return {DelaySearch::everywhere, q_.numbers.longest_delay_s}; }
  double shortest_way() const { return sticking_bounds(rows().training->front().resolution).most_length; }

  void tell(char const* stage, std::size_t done, std::size_t total) const {
    if (q_.progress) q_.progress(stage, done, total);
  }

  bool has_room() const {
    return accepted_.size() < q_.most_effects && result_.facts.steps.size() < 2 * q_.most_effects + 2;
  }

  FittedModel fitted_with(std::vector<ShapedEffect> effects, FittedStrips const& sizes) const {
    return fitted_model(rows(), q_.regressor, std::move(effects), &sizes, free_delay());
  }

  std::vector<ShapedEffect> effects_now() const {
    std::vector<ShapedEffect> effects;
    for (auto const& one : accepted_) effects.push_back({one.effect, one.shape});
    return effects;
  }

  std::vector<ShapedEffect> effects_without(std::size_t effect) const {
    auto effects = effects_now();
    effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(effect));
    return effects;
  }

  FittedModel fitted_without(std::size_t effect) const {
    return fitted_with(effects_without(effect), *result_.final.fitted);
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
  }

  // effects of one kind that may be asked now; one that is no wave only once
  std::vector<Effect const*> effects_to_ask(bool of_clock) const {
    std::vector<Effect const*> effects;
    for (auto const* effect : q_.effects) {
      bool const is_taken =
          std::any_of(accepted_.begin(), accepted_.end(), [&](auto const& one) { return one.effect == effect; });
      if (is_clock_bound(*effect) != of_clock || (is_taken && !effect->may_come_again()) || effect->is_torque_timing())
        continue;
      effects.push_back(effect);
    }
    return effects;
  }

  // effects of a clock come after those of the motion, which are asked again beside every new model
  bool has_taken_one() {
    result_.facts.last_steps = 0;
    if (step(false)) return true;
    auto const& steps = result_.facts.steps;
    bool const is_borne = result_.facts.last_steps == 0 || bears_effects_of_clock(steps.back());
    return is_borne && has_room() && step(true);
  }

  TrialModel trial_model(FittedModel const& fitted, std::vector<ShapedEffect> const& effects, Score const& score,
                         double judged) const {
    return {rows(), fitted, effects, score, scales(), judged};
  }

  // whether an effect was taken
  bool step(bool of_clock) {
    FoldKind const kind = of_clock ? FoldKind::interleaved : FoldKind::whole;
    auto questions = effect_questions(effects_to_ask(of_clock), scales(), shortest_way());
    if (questions.empty() && (of_clock || accepted_.empty()))
      return false;  // a model with effects is still asked for more
    tell("search", 0, questions.size());
    FittedStrips const& recording = *result_.final.fitted;
    Score const score(recording.base(), recording.residual(), recording.guard(), kind);
    auto const findings = scan_recording(questions, recording, score, q_.threads);
    auto const effects = effects_now();
    TrialModel const beside = trial_model(result_.final, effects, score, judged_);
    Eigen::VectorXd const gains = gains_of(findings);
    auto tried = tried_effects(q_, beside, questions, findings,
                               first_of(by_value(gains), static_cast<std::size_t>(q_.numbers.refined)), kind);
    tell("search", questions.size(), questions.size());
    std::vector<bool> const no_effect(questions.size(), false);
    AskedEffects asked{std::vector<bool>(questions.size(), true), no_effect, no_effect};
    for (auto const& one : tried) {
      Refusal const refusal = one.facts.refusal;
      asked.open[one.question] = asked.nameable[one.question] = refusal == Refusal::none;
      asked.doubted[one.question] = refusal == Refusal::at_bound || refusal == Refusal::not_predicted;
    }
    SmoothCorrections const corrections =
        smooth_corrections(recording, {recording.base(), recording.residual(), recording.guard()});
    ReplicateTask const task{result_.final,
                             left_beside_effect(tried),
                             gains,
                             asked,
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
    for (auto const& effect : facts.effects) levels_[effect.effect] = effect.level;
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
    std::vector<std::size_t> further = first_of(by_value(relative), static_cast<std::size_t>(q_.numbers.refined));
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
    return first == tried.end() ? result_.final.fitted->residual() : first->with.fitted->residual();
  }

  // of all effects, largest T first
  std::vector<EffectFacts> effect_facts(std::vector<EffectQuestion> const& questions,
                                        std::vector<EffectFinding> const& findings,
                                        std::vector<TriedEffect> const& tried, Chance const& chance) const {
    Eigen::VectorXd const p = chance.p(gains_of(findings)), level = chance.level(q_.numbers.alpha);
    std::vector<EffectFacts> effects;
    for (std::size_t const i : by_value(chance.relative(gains_of(findings)))) {
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
      accepted_.push_back(*effect);
      // once more, with the loads and levels that the joint has beside the effect: without it they are bent
      fit_final(*one.with.fitted);
      return true;
    }
    return false;
  }

  // with all shapes fitted together
  void fit_final(FittedStrips const& sizes) {
    auto const with = [&](std::vector<ShapedEffect> effects) { return fitted_with(std::move(effects), sizes); };
    result_.final = with_fitted_shapes(with(effects_now()), with);
    for (std::size_t i = 0; i < accepted_.size(); ++i) accepted_[i].shape = result_.final.model->effects()[i].shape;
    judged_ = errors_of(rows(), result_.final).judged();
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

  // D of one effect of the final model against the model without it
  double gain_beside(FittedModel const& without, std::size_t effect) const {
    Score const score(without.fitted->base(), without.fitted->residual(), without.fitted->guard(),
                      folds_of(*accepted_[effect].effect));
    return score.gain(effect_group(*without.fitted, score.basis(), *accepted_[effect].effect, accepted_[effect].shape),
                      0);
  }

  double level_of(Effect const* effect) const {
    auto const found = levels_.find(effect);
    return found == levels_.end() ? 0.0 : found->second;
  }

  // D that chance gives a rival beside the model that the effect was taken beside; later models give it their own
  double level_beside(Effect const* effect, Effect const* rival) const {
    auto const of = [](StepFacts const& step, Effect const* asked) {
      return std::find_if(step.effects.begin(), step.effects.end(),
                          [&](EffectFacts const& one) { return one.effect == asked; });
    };
    for (auto const& step : result_.facts.steps) {
      auto const taken = of(step, effect), asked = of(step, rival);
      if (taken != step.effects.end() && taken->refusal == Refusal::none && asked != step.effects.end())
        return asked->level;
    }
    return level_of(rival);
  }

  // effects taken early that later ones, or the delay beside them, have made useless
  void drop_useless() {
    while (!accepted_.empty()) {
      std::size_t weakest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < accepted_.size(); ++i)
        if (double const gain = gain_beside(fitted_without(i), i) - level_of(accepted_[i].effect); gain < least) {
          least = gain;
          weakest = i;
        }
      if (least > 0.0) return;
      FittedModel without = fitted_without(weakest);
      double const judged = errors_of(rows(), without).judged();
      if (judged > judged_) return;  // another recording needs it
      drop(weakest, std::move(without), judged);
    }
  }

  void drop(std::size_t effect, FittedModel without, double judged) {
    result_.final = std::move(without);
    judged_ = judged;
    accepted_.erase(accepted_.begin() + static_cast<std::ptrdiff_t>(effect));
  }

  // an error on judged rows, by what is worth a name
  bool is_higher(double judged, double than) const { return (1.0 - q_.numbers.least_fall) * judged > than; }

  // effects that could stand in its place about as well; other recordings say which of them stands there
  void find_rivals(std::size_t place) {
    Effect const* const effect = accepted_[place].effect;
    FoldKind const kind = folds_of(*effect);
    auto const others = effects_without(place);
    FittedModel const without = fitted_with(others, *result_.final.fitted);
    Score const score(without.fitted->base(), without.fitted->residual(), without.fitted->guard(), kind);
    std::vector<Effect const*> asked = effects_to_ask(false);
    if (kind == FoldKind::interleaved) {
      auto const of_clock = effects_to_ask(true);
      asked.insert(asked.end(), of_clock.begin(), of_clock.end());
    }
    std::erase(asked, effect);
    auto const questions = effect_questions(asked, scales(), shortest_way());
    auto const findings = scan_recording(questions, *without.fitted, score, q_.threads);
    double const gain = gain_beside(without, place), judged = errors_of(rows(), without).judged();
    double const as_it_is = kind == FoldKind::interleaved ? error_on_folds(rows(), result_.final) : judged_;
    auto tried =
        tried_effects(q_, trial_model(without, others, score, judged), questions, findings,
                      first_of(by_value(gains_of(findings)), static_cast<std::size_t>(q_.numbers.refined)), kind);
    std::erase_if(tried, [&](TriedEffect const& one) {
      double const own = level_beside(effect, one.facts.effect);
      double const least = gain - std::max(level_beside(effect, effect), own);
      bool const is_as_good = one.facts.gain >= least || !is_higher(one.facts.judged_after, as_it_is);
      return one.facts.refusal != Refusal::none || one.facts.gain < own || !is_as_good;
    });
    accepted_[place].gain = gain;
    for (auto const& one : tried) accepted_[place].rivals.push_back(one.facts.effect);
    if (auto const weight = weight_in_place_of(*effect, tried); weight != tried.end())
      return stand_instead(place, std::move(*weight));
    auto const best = std::min_element(tried.begin(), tried.end(), [](TriedEffect const& a, TriedEffect const& b) {
      return a.facts.judged_after < b.facts.judged_after;
    });
    if (rows().validation.empty() || best == tried.end()) return;
    if (best->facts.judged_after < as_it_is) stand_instead(place, std::move(*best));
  }

  // Every link has a weight unless its axis is upright, few have a spring: where both serve, the weight stands first.
  // Other recordings may speak against it
  std::vector<TriedEffect>::iterator weight_in_place_of(Effect const& effect, std::vector<TriedEffect>& tried) const {
    if (effect.family() != EffectFamily::static_position || effect.is_weight()) return tried.end();
    return std::find_if(tried.begin(), tried.end(), [&](TriedEffect const& one) {
      bool const is_refuted = !rows().validation.empty() && is_higher(one.facts.judged_after, judged_);
      return one.facts.effect->is_weight() && !is_refuted;
    });
  }

  void stand_instead(std::size_t effect, TriedEffect by) {
    EffectFacts& place = accepted_[effect];
    std::replace(place.rivals.begin(), place.rivals.end(), by.facts.effect, place.effect);
    by.facts.rivals = std::move(place.rivals);
    by.facts.p = place.p;
    by.facts.level = level_of(by.facts.effect);
    // the model has its effects in the order of the names
    std::rotate(accepted_.begin() + static_cast<std::ptrdiff_t>(effect),
                accepted_.begin() + static_cast<std::ptrdiff_t>(effect) + 1, accepted_.end());
    accepted_.back() = std::move(by.facts);
    result_.final = std::move(by.with);
    judged_ = errors_of(rows(), result_.final).judged();
  }

  // effects of a clock explain what any incomplete model leaves
  void drop_effects_of_clock() {
    for (std::size_t effect = accepted_.size(); effect-- > 0;) {
      if (!is_clock_bound(*accepted_[effect].effect)) continue;
      FittedModel without = fitted_without(effect);
      double const judged = errors_of(rows(), without).judged();
      drop(effect, std::move(without), judged);
    }
  }

  std::span<StepFacts const> last_steps() const {
    return std::span(result_.facts.steps).last(result_.facts.last_steps);
  }

  void finish() {
    DecisionFacts& facts = result_.facts;
    facts.is_complete = is_complete(last_steps(), q_.numbers);
    if (!facts.is_complete) drop_effects_of_clock();
    // from the last one on: an effect that another stands for goes to the end
    for (std::size_t i = accepted_.size(); i-- > 0;) find_rivals(i);
    facts.accepted = accepted_;
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
  std::vector<EffectFacts> accepted_{};
  std::map<Effect const*, double> levels_{};  // D by chance of each effect, as last asked
  std::vector<double> chance_of_delay_{};
  double judged_ = 0.0;  // error of the final model on judged rows
  JointDecision result_{};
};

}  // namespace

JointDecision decide_joint(DecisionQuestion const& question) { return Search(question).run(); }

}  // namespace torquescope
