#include "engine/search/friction_buildup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/search/backward_selection.hpp"
#include "engine/search/buildup_trial.hpp"
#include "engine/search/joint_refinement.hpp"
#include "engine/search/reached_bound.hpp"
#include "engine/statistics/multiple_testing.hpp"

namespace torquescope {
namespace {

// of all that is missing at reversals, by twins
constexpr double most_of_it = 0.5;

// a law of the speed alone, like Stribeck's, is within the nuisance at reversals
bool remembers_reversals(Effect const& effect) {
  auto const& signature = effect.signature();
  return !signature.empty() && (signature.front() == SignatureAxis::since_velocity_reversal ||
                                signature.front() == SignatureAxis::since_torque_reversal);
}

struct Findings {
  std::vector<EffectScan> scans;
  std::vector<double> q;
};

class SecondLook {
 public:
  SecondLook(StageSetting const& setting, SelectionOptions const& options, Selection& selection,
             StageSink const& progress)
      : setting_(setting), options_(options), selection_(selection), progress_(progress) {
    setting_.weights = selection.final->pipeline->weights();
    setting_.loop = std::make_shared<RecordedLoop const>(selection.final->twin->loop);
    setting_.wander = selection.wander;
  }

  bool run() {
    if (!has_candidate() || others_remember_reversals()) return false;
    try {
      if (!leave_out_buildup()) return false;
      setting_.keeps_reversals = true;
      if (!compare(std::min(draft_twins, setting_.twins)) || !is_anything_left()) return false;
      if (setting_.twins > draft_twins && (!compare(setting_.twins) || !is_anything_left())) return false;
      selection_.differs_at_reversals = true;
      return take_any();
    } catch (Error const&) {
      return false;  // these rows cannot be fitted: what the masked ones said stands
    }
  }

 private:
  bool has_candidate() const {
    return std::any_of(options_.candidates.begin(), options_.candidates.end(),
                       [](Effect const* effect) { return is_buildup(*effect); });
  }

  bool others_remember_reversals() const {
    return std::any_of(selection_.accepted.begin(), selection_.accepted.end(), [](AcceptedEffect const& one) {
      return !is_buildup(*one.effect) && remembers_reversals(*one.effect);
    });
  }

  // What the mask left of such friction may have got its name already. It is asked for anew, beside all other names
  bool leave_out_buildup() {
    auto const& final = *selection_.final;
    Eigen::VectorXd const& all = final.parameters();
    auto const n_baseline = static_cast<Eigen::Index>(setting_.regressor.size());
    std::vector<double> kept(all.data(), all.data() + n_baseline);
    std::vector<ShapedEffect> effects;
    for (std::size_t i = 0; i < selection_.accepted.size(); ++i) {
      ShapedEffect const& one = final.model().effects()[i];
      if (is_buildup(*one.effect)) continue;
      accepted_.push_back(selection_.accepted[i]);
      effects.push_back(one);
      double const* first = all.data() + final.model().first_parameter(i);
      kept.insert(kept.end(), first, first + one.effect->n_linear());
    }
    if (effects.size() == selection_.accepted.size()) return true;
    StageSetting own = setting_;
    own.twins = std::min(setting_.twins, draft_twins);
    own.levels = levels_of(*final.twin);
    own.levels->parameters = Eigen::Map<Eigen::VectorXd const>(kept.data(), static_cast<Eigen::Index>(kept.size()));
    auto stage = make_stage(own, JointModel(setting_.regressor, final.reference(), std::move(effects)));
    if (stage) without_ = std::make_unique<ModelStage>(std::move(*stage));
    return without_ != nullptr;
  }

  // the model so far, on masked rows
  ModelStage const& before() const { return without_ ? *without_ : *selection_.final; }

  // recording and twins of the model so far, on rows with reversals
  bool compare(std::size_t twins) {
    auto const& final = before();
    rows_.pipeline = std::make_unique<RecordPipeline>(pipeline_for(setting_, setting_.recording, final));
    if (setting_.weights) rows_.pipeline->weigh_with(setting_.weights);
    TwinAddress const null_set{setting_.seed, 0, first_free_twin_set};
    rows_.comparison =
        compare_with_twins(setting_.recording, final.twin->twin, *rows_.pipeline, null_set, twins, setting_.workers());
    if (rows_.comparison.ran_away) return false;
    rows_.twin = final.twin;
    rows_.energy = mismatch_energy(rows_.comparison.rows);
    return true;
  }

  bool is_anything_left() const { return is_significant(rows_); }

  bool take_any() {
    BuildupLook const look{rows_,           before().reference(),     before().parameters(),
                           options_.q,      options_.shape_optimiser, setting_.seed,
                           setting_.threads};
    Findings found{scan_candidates(buildup_columns(look, DrivenBy::twin), options_.candidates, setting_.threads), {}};
    found.q = q_of(found.scans);
    for (DrivenBy const motion : {DrivenBy::twin, DrivenBy::recording}) {
      auto const trial = buildup_trial(look, motion, found.scans, found.q, selection_.evaluations);
      if (trial && take(*trial, found)) return true;
    }
    return false;
  }

  bool take(Trial const& trial, Findings const& found) {
    auto const& refined = trial.refined;
    progress_told(0);
    std::vector<ShapedEffect> effects = before().model().effects();
    effects.push_back({refined.effect, refined.shape});
    StageSetting own = setting_;
    own.levels = levels_of(*before().twin);
    Eigen::VectorXd const& known = before().twin->baseline.parameters;
    Eigen::VectorXd start(known.size() + refined.parameters.size());
    start << known, refined.parameters;
    own.levels->parameters = start;
    auto draft = refined_draft(own, before().reference(), std::move(effects));
    if (!draft || energy_about_true_mean(*draft) > energy_about_true_mean(rows_) - most_of_it * rows_.energy.excess)
      return false;
    own.levels = levels_of(*draft->twin);
    auto next = make_stage(own, draft->model());
    auto baseline = baseline_with_reversals();
    progress_told(setting_.twins);
    if (!next || !baseline || is_far_too_large(*next, before().reference().scales) || bound_of_last(*next) ||
        energy_about_true_mean(*next) > energy_about_true_mean(*baseline) - confirmed_share * refined.gain)
      return false;
    put(trial, found, std::move(*baseline), std::move(*next));
    if (selection_.accepted.size() > 1) revise_selection(setting_, options_, selection_);
    return true;
  }

  std::optional<ModelStage> baseline_with_reversals() const {
    StageSetting own = setting_;
    own.levels = levels_of(*selection_.final->twin);
    own.levels->parameters = selection_.baseline->twin->baseline.parameters;
    return make_stage(own, setting_.regressor);
  }

  void put(Trial const& trial, Findings const& found, ModelStage baseline, ModelStage final) {
    selection_.accepted = accepted_;
    for (auto& one : selection_.accepted) {
      one.gain *= selection_.energy_unit;
      one.cv_gain *= selection_.energy_unit;
    }
    selection_.energy_unit = 1.0;
    selection_.first_energy = baseline.energy;
    selection_.first_excess = std::max(baseline.energy.excess, trial.refined.gain);
    bool const was_open = selection_.is_gate_open;
    for (std::size_t i = 0; i < found.scans.size(); ++i) {
      if (was_open && !is_buildup(*found.scans[i].effect)) continue;
      selection_.first_scan[i] = found.scans[i];
      selection_.first_q[i] = found.q[i];
      if (selection_.first_scan[i].effect == trial.refined.effect) selection_.first_cv_gain[i] = trial.cv.gain;
    }
    selection_.is_gate_open = true;
    selection_.keeps_reversals = true;
    selection_.differs_at_reversals = false;
    selection_.accepted.push_back({trial.refined.effect, trial.scan, trial.q, trial.refined.gain, trial.cv.gain,
                                   std::numeric_limits<double>::quiet_NaN()});
    selection_.baseline = std::make_shared<ModelStage const>(std::move(baseline));
    selection_.final = std::make_shared<ModelStage const>(std::move(final));
  }

  void progress_told(std::size_t done) const {
    if (progress_) progress_("twins", done, setting_.twins);
  }

  StageSetting setting_;
  SelectionOptions const& options_;
  Selection& selection_;
  StageSink const& progress_;
  std::vector<AcceptedEffect> accepted_{};  // what was named, but for friction that builds up
  std::unique_ptr<ModelStage> without_{};   // the model of these; none: it is the selection's
  ModelStage rows_;                         // the model so far, on rows with reversals
};

}  // namespace

bool look_at_reversals(StageSetting const& setting, SelectionOptions const& options, Selection& selection,
                       StageSink const& progress) {
  return SecondLook(setting, options, selection, progress).run();
}

}  // namespace torquescope
