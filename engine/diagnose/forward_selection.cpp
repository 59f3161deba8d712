#include "engine/diagnose/forward_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/diagnose/backward_selection.hpp"
#include "engine/diagnose/joint_refinement.hpp"
#include "engine/diagnose/multiple_testing.hpp"
#include "engine/diagnose/region_consistency.hpp"
#include "engine/diagnose/scaled_solution.hpp"
#include "engine/diagnose/trial_order.hpp"

namespace torquescope {
namespace {

constexpr double least_share_of_rest = 0.25;
constexpr double worth_another = 0.03;  // of the whole: what judge_remainder() finds worth a word
constexpr std::size_t n_refined = 5;

class Search {
 public:
  Search(StageSetting setting, SelectionOptions const& options, StageSink const& progress)
      : setting_(std::move(setting)), options_(options), progress_(progress) {}

  Selection run() {
    tell("twins", 0, setting_.twins);
    auto first = make_stage(setting_, setting_.regressor);
    tell("twins", setting_.twins, setting_.twins);
    validate(first.has_value(), [&] {
      Problem problem{ExitCode::bad_data, setting_.recording.name + ": the fitted joint cannot follow the reference"};
      problem.help = "check recording.columns, units and torque_per_unit: the torque may be another signal";
      return problem;
    });
    stage_ = std::move(*first);
    setting_.loop = std::make_shared<RecordedLoop const>(stage_.twin->loop);
    setting_.weights = stage_.pipeline->weights();
    while (take_one()) {
    }
    if (selection_.accepted.size() > 1) revise_selection(setting_, options_, selection_, stage_);
    return finish();
  }

 private:
  void tell(char const* what, std::size_t done, std::size_t total) const {
    if (progress_) progress_(what, done, total);
  }

  double whole() const { return selection_.whole(); }

  void reject(Effect const* effect, std::string reason) { selection_.rejected.push_back({effect, std::move(reason)}); }

  // one round of search; false when nothing more is to be found
  bool take_one() {
    std::size_t const step = selection_.accepted.size();
    bool const is_first = step == 0;
    if (step >= options_.max_effects) return false;
    tell("search", 0, options_.candidates.size());
    CandidateColumns const columns(*stage_.pipeline, stage_.comparison, stage_.reference(), stage_.parameters());
    auto scans = scan_candidates(columns, options_.candidates, setting_.threads);
    std::vector<double> const q = q_of(scans);
    double found = 0.0;  // most that a candidate beyond chance explains
    for (std::size_t i = 0; i < scans.size(); ++i)
      if (q[i] <= options_.q) found = std::max(found, scans[i].gain);
    remaining_ = std::max(stage_.energy.excess, found);
    bool const is_clear = is_significant(stage_) || energy_share(stage_, found) > smallest_mismatch_share;
    // what a first name leaves is as certain as the name: to be worth another it must be more than a word's worth of the whole
    bool const may_be_faint = found > 0.0 && !is_clear && (is_first || found > worth_another * whole());
    double const certain = may_be_faint ? largest_certain_share(columns, scans, q) : 0.0;
    is_faint_ = is_first && !is_clear && certain <= smallest_mismatch_share;
    bool const is_open = found > 0.0 && (is_clear || certain > smallest_faint_share);
    if (is_first) {
      selection_.first_energy = stage_.energy;
      selection_.first_scan = scans;
      selection_.first_q = q;
      selection_.first_cv_gain.assign(scans.size(), std::numeric_limits<double>::quiet_NaN());
      selection_.first_excess = remaining_;
      selection_.is_gate_open = is_open || is_significant(stage_);
    }
    if (!is_open) {
      tell("search", scans.size(), scans.size());
      return false;
    }
    std::vector<Trial> const trials = refined_trials(columns, scans, q, is_first);
    tell("search", scans.size(), scans.size());
    for (Trial const& trial : trials)
      if (accept(columns, trial)) return true;
    return false;
  }

  // Of the candidates that are certain, the largest torque beside the model's own, as a share of the whole torque. Of the
  // torque itself, not of its weighed energy: a change of friction over time counts for little there, because friction may
  // wander, and can be large
  double largest_certain_share(CandidateColumns const& columns, std::vector<EffectScan> const& scans,
                               std::vector<double> const& q) const {
    Eigen::MatrixXd const& model = stage_.comparison.common.columns_themselves();
    double largest = 0.0;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (!scans[i].is_testable || q[i] > faint_q || scans[i].gain <= 0.0) continue;
      Eigen::VectorXd const torque = columns.plain_columns(*scans[i].effect, scans[i].shape) * scans[i].parameters;
      largest = std::max(largest, (torque - model * solve_scaled(model, torque)).squaredNorm());
    }
    return energy_share(stage_, largest);
  }

  // the candidates worth a closer look, best first
  std::vector<Trial> refined_trials(CandidateColumns const& columns, std::vector<EffectScan> const& scans,
                                    std::vector<double> const& q, bool is_first) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < scans.size(); ++i)
      if (scans[i].is_testable && q[i] <= options_.q && scans[i].gain > 0.0 && !is_taken(scans[i].effect))
        order.push_back(i);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return scans[a].gain > scans[b].gain; });
    order.resize(std::min(order.size(), n_refined));

    Eigen::VectorXd const mismatch = stage_.mismatch();
    ShapeSearch const search = shape_search(options_.shape_optimiser, setting_.seed);
    Eigen::Index const guard = guard_rows(*stage_.pipeline);
    std::vector<Trial> trials;
    for (std::size_t i : order) {
      Trial trial{scans[i], q[i], refine_shape(columns, scans[i], mismatch, search, setting_.threads), {}};
      selection_.evaluations += trial.refined.evaluations;
      trial.cv = blocked_gain(mismatch, columns.model_columns(),
                              columns.columns(*trial.refined.effect, trial.refined.shape), guard);
      if (is_first) selection_.first_cv_gain[i] = trial.cv.gain;
      trials.push_back(std::move(trial));
    }
    return in_order_of_trial(std::move(trials));
  }

  // waves may be named again: a second order is another wave
  bool is_taken(Effect const* effect) const { return !effect->is_wave() && selection_.has_accepted(effect); }

  // true: the stage is another one; false: the next best may be tried
  bool accept(CandidateColumns const& columns, Trial const& trial) {
    auto const* effect = trial.refined.effect;
    double const gain = trial.refined.gain;
    if (gain < least_share_of_rest * remaining_ || gain < least_share_of_whole * whole()) {
      reject(effect,
             fmt::format("explains {:.0f} % of what is left (a quarter is asked for)", 100.0 * gain / remaining_));
      return false;
    }
    if (!effect->is_plausible(trial.refined.shape, columns.scales())) {
      reject(effect, "its best shape is none that it could have");
      return false;
    }
    RegionConsistency const region = region_of(columns, trial.refined);
    if (!region.holds() && setting_.ablation.region_consistency) {
      reject(effect, fmt::format("takes {:.0f} % of its gain where it acts ({:.0f} % is asked for)",
                                 100.0 * region.share, 100.0 * region.asked_for));
      return false;
    }
    // what happens once cannot be checked on other blocks, and fits whatever twins cannot repeat: more is asked of it
    if (effect->is_event() && is_faint_) {
      reject(effect, "happens once, and is too faint to be told from what twins cannot repeat");
      return false;
    }
    if (effect->is_event() && gain < least_share_of_rest * whole()) {
      reject(effect, fmt::format("happens once, and explains {:.0f} % of the whole (a quarter is asked for)",
                                 100.0 * gain / whole()));
      return false;
    }
    if (!effect->is_event() && !helps_elsewhere(trial.cv, gain)) {
      reject(effect, "does not help on blocks it was not fitted to");
      return false;
    }
    if (effect->family() == EffectFamily::time && setting_.wander == WanderReading::beside_motion) {
      if (begin_again_with_wander()) return true;
      reject(effect, "twins whose friction wanders do not follow the reference");
      return false;
    }
    std::vector<ShapedEffect> effects = stage_.model().effects();
    effects.push_back({effect, trial.refined.shape});
    auto next = refined_draft(setting_, stage_.reference(), std::move(effects));
    if (!next) {
      reject(effect, "twins with it do not follow the reference");
      return false;
    }
    // the twins must confirm at least a third of what the projection promised: where parts knock against each other twins
    // that are right in all but a little repeat no more of it
    if (energy_about_true_mean(*next) > energy_about_true_mean(stage_) - confirmed_share * gain) {
      reject(effect, "twins with it leave as much as twins without it");
      return false;
    }
    tell("twins", 0, setting_.twins);
    auto whole = reweighed_stage(setting_, *next);
    tell("twins", setting_.twins, setting_.twins);
    if (!whole) {
      reject(effect, "twins with it do not follow the reference");
      return false;
    }
    double const unit = selection_.energy_unit;
    selection_.accepted.push_back({effect, trial.scan, trial.q, gain / unit, trial.cv.gain / unit, region.share});
    next = std::move(whole);
    selection_.energy_unit *= energy_unit_under(stage_, *next->pipeline);
    setting_.weights = next->pipeline->weights();
    keep_baseline();
    stage_ = std::move(*next);
    return true;
  }

  RegionConsistency region_of(CandidateColumns const& columns, RefinedEffect const& refined) const {
    OrthonormalGroup const group = columns.group(*refined.effect, refined.shape);
    Eigen::VectorXd const torque = group.q * (group.r * refined.parameters);
    auto const& rows = stage_.comparison.rows;
    Eigen::VectorXd mismatch = stage_.mismatch();
    mismatch -= columns.nuisance() * (columns.nuisance().transpose() * mismatch);
    return region_consistency(torque, mismatch, rows.twins.colwise() - rows.twin_mean);
  }

  // A change over time must stand against the most that friction may wander, and so must all that is found beside it: the
  // whole search begins again among such twins. False when they cannot be made.
  bool begin_again_with_wander() {
    StageSetting wandering = setting_;
    wandering.wander = WanderReading::by_itself;
    wandering.weights = nullptr;
    tell("twins", 0, setting_.twins);
    std::optional<ModelStage> first;
    try {
      first = make_stage(wandering, setting_.regressor);
    } catch (Error const&) {
      // the recording itself was good enough for twins that wander less
    }
    tell("twins", setting_.twins, setting_.twins);
    if (!first) return false;
    setting_.wander = WanderReading::by_itself;
    setting_.weights = first->pipeline->weights();
    Selection fresh;
    fresh.evaluations = selection_.evaluations;
    selection_ = std::move(fresh);
    stage_ = std::move(*first);
    return true;
  }

  // the first stage is asked for again at the end
  void keep_baseline() {
    if (stage_.model().effects().empty()) selection_.baseline = std::move(stage_);
  }

  Selection finish() {
    selection_.final = std::move(stage_);
    selection_.wander = setting_.wander;
    return std::move(selection_);
  }

  StageSetting setting_;
  SelectionOptions const& options_;
  StageSink const& progress_;
  ModelStage stage_;
  Selection selection_;
  double remaining_ = 0.0;  // energy that this round looks for
  bool is_faint_ = false;   // this round's gate is open for a candidate's certainty, not for its size
};

}  // namespace

double Selection::whole() const { return std::max(first_excess * energy_unit, std::numeric_limits<double>::min()); }

bool Selection::has_accepted(Effect const* effect) const {
  return std::any_of(accepted.begin(), accepted.end(), [&](auto const& one) { return one.effect == effect; });
}

std::vector<double> q_of(std::vector<EffectScan> const& scans) {
  std::vector<double> p;
  std::vector<std::string> family;
  for (auto const& scan : scans) {
    p.push_back(scan.p);
    family.push_back(word(scan.effect->family()));
  }
  return hierarchical_q(p, family);
}

double energy_about_true_mean(ModelStage const& stage) {
  return stage.mismatch().squaredNorm() - stage.energy.noise / static_cast<double>(stage.comparison.rows.n_twins() + 1);
}

double energy_share(ModelStage const& stage, double energy) {
  double const whole = stage.comparison.rows.torque.squaredNorm();
  return whole > 0.0 ? std::sqrt(std::max(0.0, energy) / whole) : 0.0;
}

double mismatch_share(ModelStage const& stage) { return energy_share(stage, stage.energy.excess); }

bool is_significant(ModelStage const& stage) {
  return stage.energy.z > smallest_omnibus_z && mismatch_share(stage) > smallest_mismatch_share;
}

Selection select_effects(StageSetting const& setting, SelectionOptions const& options, StageSink const& progress) {
  return Search(setting, options, progress).run();
}

}  // namespace torquescope
