#include "engine/decision/joint_decision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/decision/delay_decision.hpp"
#include "engine/decision/law_shape.hpp"
#include "engine/decision/replicate_gains.hpp"
#include "engine/decision/smooth_correction.hpp"
#include "engine/decision/sticking_shape.hpp"
#include "engine/effects/carry_over.hpp"
#include "engine/rollout/effective_samples.hpp"
#include "engine/statistics/twin_null.hpp"

namespace torquescope {
namespace {

// places in order of falling gain
std::vector<std::size_t> by_gain(std::vector<LawFinding> const& findings) {
  std::vector<std::size_t> order(findings.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return findings[a].gain > findings[b].gain; });
  return order;
}

Eigen::VectorXd gains_of(std::vector<LawFinding> const& findings) {
  Eigen::VectorXd gains(static_cast<Eigen::Index>(findings.size()));
  for (std::size_t i = 0; i < findings.size(); ++i) gains[static_cast<Eigen::Index>(i)] = findings[i].gain;
  return gains;
}

FoldKind folds_of(Effect const& law) { return is_clock_bound(law) ? FoldKind::interleaved : FoldKind::whole; }

class Search {
 public:
  explicit Search(DecisionQuestion const& question) : q_(question) { result_.rows = joint_strips(question); }

  JointDecision run() && {
    FittedModel const plain = fitted_model(result_.rows, q_.regressor, {}, nullptr, free_delay());
    result_.baseline = fitted_with({}, *plain.fitted);
    result_.final = fitted_with({}, *plain.fitted);
    note_rows();
    // laws of a clock come after those of the motion, which are asked again beside every new model
    while (has_room() && (step(false) || (has_room() && step(true)))) drop_useless();
    finish();
    return std::move(result_);
  }

 private:
  JointStrips const& rows() const { return result_.rows; }
  JointScales const& scales() const { return result_.baseline.model->reference().scales; }
  DelayChoice free_delay() const { return {DelaySearch::everywhere, q_.numbers.longest_delay_s}; }
  double shortest_way() const { return sticking_bounds(rows().training.front().resolution).most_length; }

  void tell(char const* stage, std::size_t done, std::size_t total) const {
    if (q_.progress) q_.progress(stage, done, total);
  }

  bool has_room() const { return accepted_.size() < q_.most_laws && result_.facts.steps.size() < 2 * q_.most_laws + 2; }

  FittedModel fitted_with(std::vector<ShapedEffect> effects, FittedStrips const& sizes) const {
    return fitted_model(rows(), q_.regressor, std::move(effects), &sizes, free_delay());
  }

  std::vector<ShapedEffect> effects_with(LawFacts const* further) const {
    std::vector<ShapedEffect> effects;
    for (auto const& one : accepted_) effects.push_back({one.effect, one.shape});
    if (further != nullptr) effects.push_back({further->effect, further->shape});
    return effects;
  }

  FittedModel fitted_without(std::size_t law) const {
    auto effects = effects_with(nullptr);
    effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(law));
    return fitted_with(std::move(effects), *result_.final.fitted);
  }

  void note_rows() {
    double quiet = 0.0, duration = 0.0, kept = 0.0;
    for (auto const& strip : rows().training) {
      quiet += strip.quiet_share() * strip.duration_s();
      kept += strip.row_share() * strip.duration_s();
      duration += strip.duration_s();
    }
    result_.facts.quiet_share = quiet / duration;
    result_.facts.set_aside_share = std::max(0.0, 1.0 - kept / duration);
    result_.facts.torque_rms = rows().torque_rms();
  }

  // laws of one kind that may be asked now; one that is no wave only once
  std::vector<Effect const*> laws_to_ask(bool of_clock) const {
    std::vector<Effect const*> laws;
    for (auto const* law : q_.laws) {
      bool const is_taken =
          std::any_of(accepted_.begin(), accepted_.end(), [&](auto const& one) { return one.effect == law; });
      if (is_clock_bound(*law) != of_clock || (is_taken && !law->is_wave()) || law->is_torque_timing()) continue;
      laws.push_back(law);
    }
    return laws;
  }

  // whether a law was taken
  bool step(bool of_clock) {
    FoldKind const kind = of_clock ? FoldKind::interleaved : FoldKind::whole;
    auto questions = law_questions(laws_to_ask(of_clock), scales(), shortest_way());
    if (questions.empty()) return false;
    tell("search", 0, questions.size());
    FittedStrips const& recording = *result_.final.fitted;
    Score const score(recording.base(), recording.residual(), recording.guard());
    auto const findings = scan_recording(questions, recording, score, kind, q_.threads);
    auto tried = tried_laws(questions, findings, score, kind);
    tell("search", questions.size(), questions.size());
    AskedLaws asked;
    for (auto const& one : tried) {
      if (one.facts.refusal == Refusal::none) asked.first.push_back(one.question);
      if (one.facts.refusal == Refusal::at_bound || one.facts.refusal == Refusal::not_predicted)
        asked.doubted.push_back(one.question);
    }
    Eigen::VectorXd const gains = gains_of(findings);
    ReplicateGains const null = replicate_gains(q_, result_.final, questions, gains, asked, kind,
                                                static_cast<std::uint32_t>(result_.facts.steps.size()));
    if (null.chance.replicates() < 2) return false;  // no model that could be followed
    chance_of_delay_.insert(chance_of_delay_.end(), null.delays.begin(), null.delays.end());
    SmoothCorrection const correction = best_correction(recording, score);
    StepFacts facts{{},
                    null.chance.replicates(),
                    null.source,
                    of_clock,
                    visible_share(null.chance, score, kind),
                    {correction.axis, correction.gain, empirical_p(correction.gain, null.corrections),
                     correction.rms / rows().torque_rms()}};
    facts.laws = law_facts(questions, findings, tried, null.chance);
    for (auto const& law : facts.laws) levels_[law.effect] = law.level;
    bool const taken = take_first(facts.laws, tried);
    result_.facts.steps.push_back(std::move(facts));
    return taken;
  }

  struct TriedLaw {
    std::size_t question = 0;
    LawFacts facts{};
    FittedModel with{};
  };

  // The few that gain most, refined, and what but chance speaks against each of them; largest D first. Chance is asked
  // of the grid's D, which replicates have, too
  std::vector<TriedLaw> tried_laws(std::vector<LawQuestion> const& questions, std::vector<LawFinding> const& findings,
                                   Score const& score, FoldKind kind) const {
    auto const order = by_gain(findings);
    std::vector<TriedLaw> tried(std::min(q_.numbers.refined, order.size()));
    parallel_for(tried.size(), q_.threads, [&](std::size_t k, int) {
      std::size_t const i = order[k];
      if (!(findings[i].gain > 0.0)) {
        tried[k] = {i, LawFacts{questions[i].effect}, {}};
        return;
      }
      RefinedLaw const refined = refined_law(questions[i], findings[i], *result_.final.fitted, score, kind);
      LawFacts law{questions[i].effect, refined.shape, std::max(findings[i].gain, refined.gain)};
      law.size = refined.rms / rows().torque_rms();
      FittedModel with = fitted_with(effects_with(&law), *result_.final.fitted);
      law.judged_before = errors_of(rows(), result_.final).judged();
      law.judged_after = errors_of(rows(), with).judged();
      law.refusal = refusal_of(law, refined);
      tried[k] = {i, std::move(law), std::move(with)};
    });
    std::stable_sort(tried.begin(), tried.end(),
                     [](TriedLaw const& a, TriedLaw const& b) { return a.facts.gain > b.facts.gain; });
    return tried;
  }

  Refusal refusal_of(LawFacts const& law, RefinedLaw const& refined) const {
    if (!(law.size >= q_.numbers.delta)) return Refusal::too_small;
    if (refined.is_at_bound) return Refusal::at_bound;
    auto const ranges = law.effect->linear_bounds(scales());
    for (Eigen::Index k = 0; k < refined.parameters.size(); ++k)
      if (refined.parameters[k] > ranges[static_cast<std::size_t>(k)].upper) return Refusal::at_bound;
    return law.judged_after < law.judged_before ? Refusal::none : Refusal::not_predicted;
  }

  // of all laws, largest D first
  std::vector<LawFacts> law_facts(std::vector<LawQuestion> const& questions, std::vector<LawFinding> const& findings,
                                  std::vector<TriedLaw> const& tried, Chance const& chance) const {
    Eigen::VectorXd const p = chance.p(gains_of(findings)), level = chance.level(q_.numbers.alpha);
    std::vector<LawFacts> laws;
    for (std::size_t const i : by_gain(findings)) {
      auto const at = static_cast<Eigen::Index>(i);
      auto const own = std::find_if(tried.begin(), tried.end(), [&](auto const& one) { return one.question == i; });
      LawFacts law = own != tried.end()
                         ? own->facts
                         : LawFacts{questions[i].effect, questions[i].grid.point(findings[i].point), findings[i].gain};
      law.p = p[at];
      law.level = level[at];
      if (own == tried.end() || law.refusal == Refusal::none) law.refusal = Refusal::smaller;
      if (law.p > q_.numbers.alpha) law.refusal = Refusal::chance;
      laws.push_back(std::move(law));
    }
    return laws;
  }

  // the one that gains most and that nothing speaks against
  bool take_first(std::vector<LawFacts>& laws, std::vector<TriedLaw>& tried) {
    for (auto& one : tried) {
      auto const law =
          std::find_if(laws.begin(), laws.end(), [&](auto const& facts) { return facts.effect == one.facts.effect; });
      if (one.facts.refusal != Refusal::none || law->p > q_.numbers.alpha) continue;
      law->refusal = Refusal::none;
      accepted_.push_back(*law);
      // once more, with the loads and levels that the joint has beside the law: without it they are bent
      result_.final = fitted_with(effects_with(nullptr), *one.with.fitted);
      return true;
    }
    return false;
  }

  // the torque of a law of which as many laws as not would come out: S_0 falls by D / n_eff in its logarithm
  double visible_share(Chance const& chance, Score const& score, FoldKind kind) const {
    Eigen::VectorXd needed = chance.needed(q_.numbers.alpha);
    std::nth_element(needed.begin(), needed.begin() + needed.size() / 2, needed.end());
    Eigen::VectorXd const left = score.left_on_rows_with({}, 0, kind);
    double const fall = std::expm1(needed[needed.size() / 2] / effective_samples(left));
    return std::sqrt(fall * left.squaredNorm() / rows().training_energy);
  }

  // D of one law of the final model against the model without it
  double gain_beside(FittedModel const& without, std::size_t law) const {
    Score const score(without.fitted->base(), without.fitted->residual(), without.fitted->guard());
    return score.gain(law_group(*without.fitted, score.basis(), *accepted_[law].effect, accepted_[law].shape), 0,
                      folds_of(*accepted_[law].effect));
  }

  double level_of(Effect const* law) const {
    auto const found = levels_.find(law);
    return found == levels_.end() ? 0.0 : found->second;
  }

  // laws taken early that later ones, or the delay beside them, have made useless
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
      // one that another recording needs is not
      if (errors_of(rows(), without).judged() > errors_of(rows(), result_.final).judged()) return;
      result_.final = std::move(without);
      accepted_.erase(accepted_.begin() + static_cast<std::ptrdiff_t>(weakest));
    }
  }

  // laws that stand in its place about as well
  void find_rivals(std::size_t law) {
    LawFacts& own = accepted_[law];
    FoldKind const kind = folds_of(*own.effect);
    FittedModel const without = fitted_without(law);
    Score const score(without.fitted->base(), without.fitted->residual(), without.fitted->guard());
    std::vector<Effect const*> laws = laws_to_ask(false);
    if (kind == FoldKind::interleaved) {
      auto const others = laws_to_ask(true);
      laws.insert(laws.end(), others.begin(), others.end());
    }
    std::erase(laws, own.effect);
    auto const questions = law_questions(laws, scales(), shortest_way());
    auto const findings = scan_recording(questions, *without.fitted, score, kind, q_.threads);
    own.gain = gain_beside(without, law);
    auto const order = by_gain(findings);
    for (std::size_t k = 0; k < std::min(q_.numbers.refined, order.size()); ++k) {
      LawQuestion const& rival = questions[order[k]];
      LawFinding const& found = findings[order[k]];
      double const gain = std::max(found.gain, refined_law(rival, found, *without.fitted, score, kind).gain);
      double const by_chance = std::max(level_of(own.effect), level_of(rival.effect));
      if (gain > 0.0 && gain >= own.gain - by_chance) own.rivals.push_back(rival.effect);
    }
  }

  void finish() {
    for (std::size_t i = 0; i < accepted_.size(); ++i) find_rivals(i);
    DecisionFacts& facts = result_.facts;
    facts.accepted = accepted_;
    facts.delay = decided_delay(q_, rows(), result_.final, chance_of_delay_);
    // a delay that is named is a part of what the names explain
    facts.baseline = facts.delay.is_named ? errors_of(rows(), at_allowed_delay(rows(), result_.baseline))
                                          : errors_of(rows(), result_.baseline);
    facts.baseline_late_s = result_.baseline.fitted->chosen().late_s;
    facts.baseline_parameters = numbers_of(result_.baseline);
    facts.final = errors_of(rows(), result_.final);
    facts.parameters = numbers_of(result_.final);
  }

  DecisionQuestion const& q_;
  std::vector<LawFacts> accepted_{};
  std::map<Effect const*, double> levels_{};  // D by chance of each law, as last asked
  std::vector<double> chance_of_delay_{};
  JointDecision result_{};
};

}  // namespace

JointDecision decide_joint(DecisionQuestion const& question) { return Search(question).run(); }

}  // namespace torquescope
