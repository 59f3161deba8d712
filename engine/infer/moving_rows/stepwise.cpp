#include "engine/infer/moving_rows/stepwise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/effects/carry_over.hpp"
#include "engine/fit/statistics/twin_null.hpp"
#include "engine/infer/moving_rows/adequacy.hpp"
#include "engine/infer/moving_rows/pooled_fit.hpp"
#include "engine/infer/moving_rows/refined_candidates.hpp"
#include "engine/infer/moving_rows/simulated_candidate.hpp"
#include "engine/infer/moving_rows/weight_in_place.hpp"
#include "engine/infer/search/joint_refinement.hpp"
#include "engine/infer/search/reached_bound.hpp"

namespace torquescope {
namespace {

std::vector<Effect const*> laws_of(std::vector<Effect const*> const& all, bool of_the_clock) {
  std::vector<Effect const*> laws;
  for (auto const* effect : all)
    if (is_clock_bound(*effect) == of_the_clock) laws.push_back(effect);
  return laws;
}

// of the torque: what an inertia that takes less is held at, where the fitted one cannot be led
constexpr double heavier_share = 0.1;

class Search {
 public:
  Search(StageSetting const& setting, SelectionOptions const& options, DecisionLevels const& levels,
         OtherRecordings const& others, StageSink const& progress)
      : result_{{}, setting}, options_(options), levels_(levels), others_(others), progress_(progress) {}

  StepwiseSearch run() && {
    begin();
    while (!is_enough() && step(laws_of(options_.candidates, false), FoldKind::whole)) {
    }
    if (!is_enough() && leaves_most()) try_from_the_baseline();
    if (!is_enough()) try_clock_bound();
    return std::move(result_);
  }

 private:
  // what is left beside named laws is within what the form of a law may be off
  bool is_enough() const { return !result_.end().selection.accepted.empty() && result_.end().adequacy.holds(); }

  StageSetting& setting() { return result_.setting; }

  void tell(char const* what, std::size_t done, std::size_t total) const {
    if (progress_) progress_(what, done, total);
  }

  void begin() {
    tell("replicates", 0, setting().twins);
    auto first = first_stage();
    tell("replicates", setting().twins, setting().twins);
    validate(first.has_value(), [&] {
      Problem problem{ExitCode::bad_data, setting().recording.name + ": the fitted joint cannot follow the reference"};
      problem.help = "check recording.columns, units and torque_per_unit: the torque may be another signal";
      return problem;
    });
    setting().loop = std::make_shared<RecordedLoop const>(first->twin->loop);
    setting().weights = first->pipeline->weights();
    setting().motions = first->comparison.recording.motions();
    if (first->twin->colour) setting().reads_colour = true;
    SearchState state;
    state.selection.first_energy = first->energy;
    add(std::move(state), std::move(*first));
  }

  // What is missing may have taken nearly all of the inertia away, so that no loop holds the joint: then a heavier one
  // is the start, or one that a loop leads round the turns
  std::optional<ModelStage> first_stage() {
    struct Start {
      double least_inertia_share;
      bool by_turns;
    };
    std::optional<Error> unfit;
    for (Start const& start : {Start{0.0, false}, Start{heavier_share, false}, Start{0.0, true}}) {
      setting().least_inertia_share = start.least_inertia_share;
      setting().inertia_by_turns = start.by_turns;
      try {
        if (auto stage = make_stage(setting(), setting().regressor)) return stage;
      } catch (Error const& error) {
        if (!unfit) unfit = error;
      }
    }
    if (unfit) throw Error(*unfit);
    return std::nullopt;
  }

  // with its evidence, and one fit to all training recordings
  void add(SearchState state, ModelStage made) {
    auto const stage = std::make_shared<ModelStage>(std::move(made));
    state.evidence = std::make_shared<Evidence const>(setting(), *stage, others_);
    stage->pooled = pooled_fit(*stage, state.evidence->training());
    state.selection.final = stage;
    if (!state.selection.baseline) state.selection.baseline = stage;
    state.adequacy = adequacy_of(*state.evidence, levels_);
    result_.states.push_back(std::move(state));
  }

  // whether a law was taken
  bool step(std::vector<Effect const*> const& laws, FoldKind kind) {
    SearchState& state = result_.states.back();
    // a law that is dropped and comes back must not go round for ever
    if (state.selection.accepted.size() >= options_.max_effects || result_.states.size() > 2 * options_.max_effects + 1)
      return false;
    tell("search", 0, laws.size());
    if (kind == FoldKind::interleaved && state.evidence->n_unseen() > 0)
      state.evidence = std::make_shared<Evidence const>(Evidence(*state.evidence).with_own_events(laws));
    Evidence const& evidence = *state.evidence;
    CatalogueEvidence const catalogue = scan_catalogue(evidence, laws, kind, levels_.alpha, setting().threads);
    note_first(state.selection, catalogue);
    std::vector<RefinedCandidate> candidates = refined(evidence, catalogue, kind);
    candidates = in_order(std::move(candidates), evidence.rows_left(kind), levels_.tolerance);
    tell("search", laws.size(), laws.size());
    if (candidates.size() > n_simulated) candidates.resize(n_simulated);
    for (RefinedCandidate const& candidate : candidates)
      if (take(candidate, catalogue)) {
        drop_superfluous();
        prefer_weight();
        return true;
      }
    return false;
  }

  // Those that predict clearly. Parts that ring or knock are looked for over all their bounds, which takes long, only
  // where no other law explains most of what is left
  std::vector<RefinedCandidate> refined(Evidence const& evidence, CatalogueEvidence const& catalogue, FoldKind kind) {
    Selection& selection = result_.states.back().selection;
    RowsLeft const without_any = evidence.rows_left(kind);
    double const excess =
        evidence.left_in_folds().col(0).sum() -
        evidence.left_in_folds().rightCols(evidence.left_in_folds().cols() - 1).rowwise().mean().sum();
    auto laws = worth_refining(evidence, catalogue, selection);
    std::stable_partition(laws.begin(), laws.end(), [](auto const* law) { return !law->scan.effect->has_inertia(); });
    std::vector<RefinedCandidate> candidates;
    double most = 0.0;
    for (CandidateEvidence const* law : laws) {
      RefinedCandidate refined = refined_candidate(
          evidence, *law, {options_.shape_optimiser, setting().seed, setting().threads, most < most_of_it * excess});
      selection.evaluations += refined.evaluations;
      if (!(refined.evidence.scan.gain > 0.0)) continue;
      if (!leaves_clearly_less(refined.left, without_any) && !replicates_decide(evidence, refined, kind)) {
        refuse(law->scan.effect, "does not predict rows clearly better that it was not fitted to");
        continue;
      }
      most = std::max(most, refined.evidence.train);
      candidates.push_back(std::move(refined));
    }
    return candidates;
  }

  // what is left beside it is what a complete model leaves: then replicates alone say whether its gain is chance
  bool replicates_decide(Evidence const& evidence, RefinedCandidate const& candidate, FoldKind kind) const {
    auto const gain = evidence.gains(*candidate.evidence.scan.effect, {candidate.shape}, kind, candidate.driven_by);
    return leaves_chance(evidence, gain.front(), kind, levels_);
  }

  void note_first(Selection& selection, CatalogueEvidence const& catalogue) const {
    if (!selection.accepted.empty()) return;
    // laws of a clock are looked at after those of the motion, which are asked once more beside them
    for (auto const& law : catalogue.laws) {
      if (std::any_of(selection.first_scan.begin(), selection.first_scan.end(),
                      [&](EffectScan const& one) { return one.effect == law.scan.effect; }))
        continue;
      selection.first_scan.push_back(law.scan);
      selection.first_q.push_back(law.scan.p);
      selection.first_cv_gain.push_back(law.scan.is_testable ? law.train : std::numeric_limits<double>::quiet_NaN());
      if (law.scan.is_testable && law.scan.p <= levels_.alpha) {
        selection.is_gate_open = true;
        selection.first_excess = std::max(selection.first_excess, law.scan.gain);
      }
    }
    selection.first_excess = std::max(selection.first_excess, selection.first_energy.excess);
  }

  std::vector<CandidateEvidence const*> worth_refining(Evidence const& evidence, CatalogueEvidence const& catalogue,
                                                       Selection& selection) const {
    std::vector<CandidateEvidence const*> found;
    for (auto const& law : catalogue.laws) {
      if (!law.scan.is_testable || law.scan.p > levels_.alpha || !(law.scan.gain > 0.0)) continue;
      if (!law.scan.effect->may_come_again() && selection.has_accepted(law.scan.effect)) continue;
      if (evidence.n_unseen() > 0 && law.unseen < law.least_unseen) {
        selection.rejected.push_back({law.scan.effect, "predicts validation recordings worse than without it"});
        continue;
      }
      found.push_back(&law);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](auto const* a, auto const* b) { return a->scan.gain > b->scan.gain; });
    for (std::size_t i = n_refined; i < found.size(); ++i)
      selection.rejected.push_back({found[i]->scan.effect, "predicts less than the best few"});
    found.resize(std::min(found.size(), n_refined));
    return found;
  }

  bool refuse(Effect const* effect, std::string reason) {
    result_.states.back().selection.rejected.push_back({effect, std::move(reason)});
    return false;
  }

  bool take(RefinedCandidate const& candidate, CatalogueEvidence const& catalogue) {
    auto const* effect = candidate.evidence.scan.effect;
    SearchState const& state = result_.end();
    Evidence const& evidence = *state.evidence;
    if (candidate.bound) return refuse(effect, bound_words(*effect, *candidate.bound, evidence.columns().joint()));
    auto const before = state.selection.final;
    // what the simulated model takes away must be beyond chance in its recording, where the projection's gain was
    CandidateEvidence const& found = candidate.evidence;
    double const by_chance = found.first_mean + catalogue.chance * found.first_spread;
    // it may be beyond chance by the rows of other recordings alone
    double const least_taken = found.first > by_chance ? by_chance : found.first_mean;
    auto draft = simulated(setting(), evidence, candidate, least_taken);
    if (!draft) return refuse(effect, "replicates with it do not follow the reference");
    if (energy_about_true_mean(*before) - energy_about_true_mean(*draft) < least_taken)
      return refuse(effect, "replicates with it leave as much as replicates without it");
    tell("replicates", 0, setting().twins);
    auto whole = reweighed_stage(setting(), *draft);
    tell("replicates", setting().twins, setting().twins);
    if (!whole) return refuse(effect, "replicates with it do not follow the reference");
    if (is_far_too_large(*whole, before->reference().scales))
      return refuse(effect, "would have to be more than twice as large as it can be");
    accept(candidate, std::move(*whole));
    return true;
  }

  void accept(RefinedCandidate const& candidate, ModelStage whole) {
    SearchState next{result_.end().selection};
    Selection& selection = next.selection;
    auto const before = selection.final;
    double const unit = selection.energy_unit;
    auto const instead = late_torque(*before, result_.end().evidence->columns(), setting().recording.rate_hz);
    EffectScan scan = candidate.evidence.scan;
    scan.shape = candidate.shape;
    selection.accepted.push_back(
        {scan.effect, scan, scan.p, scan.gain / unit, candidate.evidence.train / unit, instead});
    selection.energy_unit *= energy_unit_under(*before, *whole.pipeline);
    setting().weights = whole.pipeline->weights();
    add(std::move(next), std::move(whole));
  }

  // laws taken early that later ones have made useless
  void drop_superfluous() {
    while (result_.end().selection.accepted.size() > 1) {
      auto const weakest = superfluous(*result_.end().evidence);
      if (!weakest) return;
      SearchState next{result_.end().selection};
      auto const at = static_cast<std::ptrdiff_t>(*weakest);
      std::vector<ShapedEffect> effects = next.selection.final->model().effects();
      effects.erase(effects.begin() + at);
      auto stage = refined_stage(setting(), next.selection.final->reference(), std::move(effects));
      if (!stage) return;
      next.selection.rejected.push_back(
          {next.selection.accepted[*weakest].effect, "adds nothing beside what was named after it"});
      next.selection.accepted.erase(next.selection.accepted.begin() + at);
      add(std::move(next), std::move(*stage));
    }
  }

  // the last state is that one: with the other law it predicts no less, and would be kept instead
  void prefer_weight() {
    SearchState const& last = result_.end();
    auto made = with_weight_in_place(setting(), last.selection, *last.evidence, options_.candidates, levels_,
                                     {options_.shape_optimiser, setting().seed, setting().threads});
    if (!made) return;
    result_.states.pop_back();
    add({std::move(made->selection)}, std::move(made->stage));
  }

  // the law whose removal is nearest to chance, where it is within it
  std::optional<std::size_t> superfluous(Evidence const& evidence) const {
    auto const& effects = evidence.stage().model().effects();
    std::optional<std::size_t> weakest;
    double largest = levels_.alpha;
    for (std::size_t i = 0; i + 1 < effects.size(); ++i) {
      Evidence const without(evidence, i);
      FoldKind const kind = is_clock_bound(*effects[i].effect) ? FoldKind::interleaved : FoldKind::whole;
      Eigen::VectorXd const gain = without.gains(*effects[i].effect, {effects[i].shape}, kind).front().total();
      double const p = empirical_p(gain[0], {gain.data() + 1, static_cast<std::size_t>(gain.size() - 1)});
      if (p <= largest) continue;
      largest = p;
      weakest = i;
    }
    return weakest;
  }

  // of what the baseline lacks, where laws were taken
  bool leaves_most() const {
    Selection const& selection = result_.end().selection;
    double const left = selection.final->energy.excess / selection.energy_unit;
    return !selection.accepted.empty() && left > (1.0 - most_of_it) * selection.first_excess;
  }

  // Laws of the motion that explain little stand in the way of one of a clock that explains all: whatever is left of
  // it looks a little like many of them
  void try_from_the_baseline() {
    std::vector<SearchState> of_the_motion = result_.states;
    auto const weights = setting().weights;
    result_.states.resize(1);
    setting().weights = result_.end().selection.final->pipeline->weights();
    try_clock_bound();
    if (is_enough()) return;
    result_.states = std::move(of_the_motion);
    setting().weights = weights;
  }

  // Laws of an instant or a clock stay only where they make the model adequate. On the short folds that they need laws
  // of the motion are asked once more: what a wave in time does at one speed, one over position does as well
  void try_clock_bound() {
    std::size_t const before = result_.states.size();
    auto const weights = setting().weights;
    while (!is_enough() && step(options_.candidates, FoldKind::interleaved)) {
    }
    auto const& accepted = result_.end().selection.accepted;
    bool const has_any =
        std::any_of(accepted.begin(), accepted.end(), [](auto const& one) { return is_clock_bound(*one.effect); });
    if (result_.states.size() == before || !has_any || result_.end().adequacy.holds()) return;
    auto const is_bound = [](SearchState const& state) {
      return std::any_of(state.selection.accepted.begin(), state.selection.accepted.end(),
                         [](auto const& one) { return is_clock_bound(*one.effect); });
    };
    auto const first = std::find_if(result_.states.begin(), result_.states.end(), is_bound);
    SearchState kept = *std::prev(first);
    for (auto const& one : accepted)
      if (is_clock_bound(*one.effect))
        kept.selection.rejected.push_back(
            {one.effect, "belongs to this recording alone, and the model with it is not adequate"});
    result_.states.erase(first, result_.states.end());
    result_.states.back() = std::move(kept);
    setting().weights = weights;
  }

  StepwiseSearch result_;
  SelectionOptions const& options_;
  DecisionLevels const& levels_;
  OtherRecordings others_;
  StageSink const& progress_;
};

}  // namespace

StepwiseSearch search_stepwise(StageSetting const& setting, SelectionOptions const& options,
                               DecisionLevels const& levels, OtherRecordings const& others, StageSink const& progress) {
  return Search(setting, options, levels, others, progress).run();
}

}  // namespace torquescope
