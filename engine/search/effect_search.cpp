#include "engine/search/effect_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/search/candidate_table.hpp"
#include "engine/search/joint_refinement.hpp"
#include "engine/search/reached_bound.hpp"
#include "engine/search/torque_itself.hpp"

namespace torquescope {
namespace {

constexpr double worth_another = 0.03;  // of the whole: what judge_remainder() finds worth a word
constexpr std::size_t n_refined = 5;

// the scans that explain something, with at most this q
std::vector<EffectScan> found_with(double most_q, std::vector<EffectScan> const& scans, std::vector<double> const& q) {
  std::vector<EffectScan> found;
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (scans[i].is_testable && q[i] <= most_q && scans[i].gain > 0.0) found.push_back(scans[i]);
  return found;
}

}  // namespace

EffectSearch::EffectSearch(StageSetting const& setting, SelectionOptions const& options, StageSink const& progress)
    : setting_(setting), options_(&options), progress_(&progress) {
  validate(begin_somehow(), [&] {
    Problem problem{ExitCode::bad_data, setting_.recording.name + ": the fitted joint cannot follow the reference"};
    problem.help = "check recording.columns, units and torque_per_unit: the torque may be another signal";
    return problem;
  });
}

// What is missing may have taken nearly all of the inertia away, so that no loop holds the joint: then a heavier one is
// the start
bool EffectSearch::begin_somehow() {
  constexpr double heavier_share = 0.1;
  double const as_a_rule = setting_.least_inertia_share;
  try {
    return begin(setting_);
  } catch (Error const& unfit) {
    setting_.least_inertia_share = heavier_share;
    try {
      return begin(setting_);
    } catch (Error const&) {
      // or rows of strokes at one speed said nothing of an inertia, and what stands for one is too heavy for the turns
      setting_.least_inertia_share = as_a_rule;
      setting_.inertia_by_turns = true;
    }
    try {
      return begin(setting_);
    } catch (Error const&) {
      throw unfit;
    }
  }
}

// forgets what was selected, unless twins cannot be made as the setting says
bool EffectSearch::begin(StageSetting const& setting) {
  tell("twins", 0, setting.twins);
  auto first = make_stage(setting, setting.regressor);
  tell("twins", setting.twins, setting.twins);
  if (!first) return false;
  setting_.wander = setting.wander;
  setting_.loop = std::make_shared<RecordedLoop const>(first->twin->loop);
  setting_.weights = first->pipeline->weights();
  // noise that the loop could not tell is read from what each model leaves
  if (first->twin->colour) setting_.reads_colour = true;
  Selection fresh;
  fresh.evaluations = selection_.evaluations;
  fresh.wander = setting.wander;
  fresh.baseline = fresh.final = std::make_shared<ModelStage const>(std::move(*first));
  selection_ = std::move(fresh);
  return true;
}

void EffectSearch::tell(char const* what, std::size_t done, std::size_t total) const {
  if (*progress_) (*progress_)(what, done, total);
}

double EffectSearch::left_share() const { return std::max(0.0, stage().energy.excess) / selection_.whole(); }

Round EffectSearch::next_round() {
  if (selection_.accepted.size() >= options_->max_effects) return {};
  std::size_t const n_candidates = options_->candidates.size();
  tell("search", 0, n_candidates);
  auto const before = selection_.final;  // the columns look at it while the line goes on
  BothMotions const columns(*before);
  auto const scans = scan_candidates(columns.twin, options_->candidates, setting_.threads);
  std::vector<double> const q = q_of(scans);
  bool const is_open = opens(columns.twin, scans, q);
  note_not_tried(selection_, scans, q, options_->q, is_open);
  if (options_->only_gate) return {};
  std::vector<Trial> trials = is_open ? refined_trials(columns, scans, q) : std::vector<Trial>{};
  tell("search", n_candidates, n_candidates);
  Round round;
  if (!trials.empty()) round.before = std::make_shared<EffectSearch const>(*this);
  double taken_gain = 0.0;
  for (Trial& trial : trials) {
    auto const* effect = trial.refined.effect;
    if (round.is_taken) {
      bool const is_near = trial.refined.gain >= nearly_as_good * taken_gain && !effect->is_event();
      // asked of the line before the round: this one has another stage now
      if (is_near && effect->family() != EffectFamily::time &&
          !round.before->refusal(columns.of(trial.driven_by), trial))
        round.nearly_taken.push_back(trial);
      note_refusal(effect, (trial.refined.gain < taken_gain ? "explains less than " : "is less simple than ") +
                               selection_.accepted.back().effect->name());
      continue;
    }
    if (auto reason = refusal(columns.of(trial.driven_by), trial)) {
      note_refusal(effect, std::move(*reason));
      continue;
    }
    if (effect->family() == EffectFamily::time && setting_.wander == WanderReading::beside_motion) {
      if (may_begin_again_ && begin_again_with_wander()) return {true, true, {}};
      note_refusal(effect, "twins whose friction wanders do not follow the reference");
      continue;
    }
    round.is_taken = take(trial);
    taken_gain = trial.refined.gain;
  }
  return round;
}

// sets what the round looks for
bool EffectSearch::opens(CandidateColumns const& columns, std::vector<EffectScan> const& scans,
                         std::vector<double> const& q) {
  bool const is_first = selection_.accepted.empty();
  double found = 0.0;  // most that a candidate beyond chance explains
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (q[i] <= options_->q) found = std::max(found, scans[i].gain);
  remaining_ = std::max(stage().energy.excess, found);
  double const drift = largest_drift_share(columns, scans, q);
  bool const is_clear =
      is_significant(stage()) || std::max(energy_share(stage(), found), drift) > smallest_mismatch_share;
  // what a first name leaves is as certain as the name: to be worth another it must be more than a word's worth of the
  // whole
  bool const may_be_faint = found > 0.0 && !is_clear && (is_first || found > worth_another * selection_.whole());
  double const certain = may_be_faint ? largest_certain_share(columns, scans, q) : 0.0;
  is_faint_ = is_first && !is_clear && certain <= smallest_mismatch_share;
  bool const is_open = found > 0.0 && (is_clear || certain > smallest_faint_share);
  if (is_first) {
    selection_.first_energy = stage().energy;
    selection_.first_scan = scans;
    selection_.first_q = q;
    selection_.first_cv_gain.assign(scans.size(), std::numeric_limits<double>::quiet_NaN());
    selection_.first_excess = remaining_;
    selection_.is_gate_open = is_open || is_significant(stage());
  }
  return is_open;
}

// of the candidates that are certain, the largest torque beside the model's own, as a share of the whole torque
double EffectSearch::largest_certain_share(CandidateColumns const& columns, std::vector<EffectScan> const& scans,
                                           std::vector<double> const& q) const {
  double largest = 0.0;
  for (EffectScan const& scan : found_with(faint_q, scans, q)) {
    if (may_be_another_loop(*scan.effect, scan.gain, scan.parameters)) continue;
    largest = std::max(largest, energy_beside(stage(), columns, {*scan.effect, scan.shape, scan.parameters}));
  }
  return energy_share(stage(), largest);
}

// Of changes of dry friction over time, beyond chance: what they take from the mismatch in the torque itself, as a
// share of the whole torque. Rows weighed by how much friction may wander make little of it, whatever its size
double EffectSearch::largest_drift_share(CandidateColumns const& columns, std::vector<EffectScan> const& scans,
                                         std::vector<double> const& q) const {
  double largest = 0.0;
  for (EffectScan const& scan : found_with(options_->q, scans, q))
    if (is_drift_of_friction(*scan.effect))
      largest = std::max(largest, gain_in_torque_itself(stage(), columns, {*scan.effect, scan.shape, scan.parameters}));
  return energy_share(stage(), largest);
}

// the candidates worth a closer look, best first
std::vector<Trial> EffectSearch::refined_trials(BothMotions const& columns, std::vector<EffectScan> const& scans,
                                                std::vector<double> const& q) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (scans[i].is_testable && q[i] <= options_->q && scans[i].gain > 0.0 && !is_taken(scans[i].effect))
      order.push_back(i);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return scans[a].gain > scans[b].gain; });
  order.resize(std::min(order.size(), n_refined));

  Eigen::VectorXd const mismatch = stage().mismatch();
  ShapeSearch const search = shape_search(options_->shape_optimiser, setting_.seed);
  Eigen::Index const guard = guard_rows(*stage().pipeline);
  std::optional<LateTorque> instead;
  if (!selection_.accepted.empty()) instead = late_torque(stage(), columns.twin, setting_.recording.rate_hz);
  std::vector<Trial> trials;
  for (std::size_t i : order) {
    Trial trial{scans[i], q[i], refine_shape(columns.twin, scans[i], mismatch, search, setting_.threads)};
    trial.instead = instead;
    trial.is_named = selection_.has_accepted(scans[i].effect);
    selection_.evaluations += trial.refined.evaluations;
    prefer_own_motion(columns.recording, trial);
    auto const& driven = columns.of(trial.driven_by);
    Eigen::MatrixXd const found = driven.columns(*trial.refined.effect, trial.refined.shape);
    trial.cv = blocked_gain(mismatch, driven.model_columns(), found, guard);
    trial.most_in_a_block = most_in_a_block(found * trial.refined.parameters);
    if (selection_.accepted.empty()) selection_.first_cv_gain[i] = trial.cv.gain;
    trials.push_back(std::move(trial));
  }
  return in_order_of_trial(std::move(trials));
}

// where the shape of the recording's own motion explains a good part more than that of the common motion
void EffectSearch::prefer_own_motion(CandidateColumns const& own, Trial& trial) {
  bool const leaves_much = trial.refined.gain < (1.0 - least_share_of_rest) * remaining_;
  Eigen::VectorXd const mismatch = stage().mismatch();
  OwnMotionShapes shapes(own, trial.scan, mismatch, options_->shape_optimiser, setting_.seed, setting_.threads);
  auto const counted = [&](std::optional<RefinedEffect> found) {
    if (found) selection_.evaluations += found->evaluations;
    return found;
  };
  auto found = counted(leaves_much ? shapes.everywhere() : shapes.nearby());
  // a load that rings or knocks explains as much on either motion, or its shape is not found yet
  bool const is_lost = !found || found->gain < (1.0 - least_share_of_rest) * trial.refined.gain;
  if (!leaves_much && is_lost && trial.scan.effect->has_inertia())
    if (auto further = counted(shapes.everywhere())) found = std::move(further);
  if (!found) return;
  if (found->gain >= trial.refined.gain + least_share_of_rest * remaining_) {
    trial.refined = std::move(*found);
    trial.driven_by = DrivenBy::recording;
  } else {
    trial.own = std::move(found);
  }
}

// waves may be named again: a second order is another wave
bool EffectSearch::is_taken(Effect const* effect) const {
  return !effect->is_wave() && selection_.has_accepted(effect);
}

// twins with the refined shape, or with that of the own motion where it promises to explain a good part of what they
// leave, and does
std::optional<ModelStage> EffectSearch::draft_of(Trial const& trial) const {
  ModelStage const& before = stage();
  auto const draft = [&](std::vector<double> const& shape) {
    std::vector<ShapedEffect> effects = before.model().effects();
    effects.push_back({trial.refined.effect, shape});
    return refined_draft(setting_, before.reference(), std::move(effects));
  };
  auto first = draft(trial.refined.shape);
  if (!trial.own) return first;
  double const promised = energy_about_true_mean(before) - trial.own->gain;
  if (first && energy_about_true_mean(*first) - promised < least_share_of_rest * remaining_) return first;
  auto other = draft(trial.own->shape);
  bool const is_nearer = other && (!first || energy_about_true_mean(*other) < energy_about_true_mean(*first));
  return is_nearer ? std::move(other) : std::move(first);
}

bool EffectSearch::take(Trial const& trial) {
  auto const* effect = trial.refined.effect;
  auto const before = selection_.final;
  auto next = draft_of(trial);
  if (!next) {
    note_refusal(effect, "twins with it do not follow the reference");
    return false;
  }
  // the twins must confirm at least a third of what the projection promised: where parts knock against each other twins
  // that are right in all but a little repeat no more of it
  double const promised = confirmed_share * trial.refined.gain;
  if (energy_about_true_mean(*next) > energy_about_true_mean(*before) - promised) {
    note_refusal(effect, "twins with it leave as much as twins without it");
    return false;
  }
  tell("twins", 0, setting_.twins);
  auto whole = reweighed_stage(setting_, *next);
  tell("twins", setting_.twins, setting_.twins);
  if (!whole) {
    note_refusal(effect, "twins with it do not follow the reference");
    return false;
  }
  if (is_far_too_large(*whole, before->reference().scales)) {
    note_refusal(effect, "would have to be more than twice as large as it can be");
    return false;
  }
  if (auto const bound = bound_of_last(*whole)) {
    note_refusal(effect, bound_words(*effect, *bound, setting_.regressor.joint()));
    return false;
  }
  double const unit = selection_.energy_unit;
  selection_.accepted.push_back({effect, trial.scan, trial.q, trial.refined.gain / unit, trial.cv.gain / unit,
                                 trial.region_share, trial.instead});
  selection_.energy_unit *= energy_unit_under(*before, *whole->pipeline);
  setting_.weights = whole->pipeline->weights();
  selection_.final = std::make_shared<ModelStage const>(std::move(*whole));
  return true;
}

// A change over time must stand against the most that friction may wander, and so must all that is found beside it: the
// whole search begins again among such twins. False when they cannot be made.
bool EffectSearch::begin_again_with_wander() {
  StageSetting wandering = setting_;
  wandering.wander = WanderReading::by_itself;
  wandering.weights = nullptr;
  try {
    return begin(wandering);
  } catch (Error const&) {
    return false;  // the recording itself was good enough for twins that wander less
  }
}

}  // namespace torquescope
