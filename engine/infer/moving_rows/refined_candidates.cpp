#include "engine/infer/moving_rows/refined_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/effects/carry_over.hpp"
#include "engine/infer/search/own_motion.hpp"

namespace torquescope {
namespace {

void take(LawGain const& gain, RefinedCandidate& best) {
  best.evidence.scan.gain = gain.total()[0];
  best.evidence.train = gain.train[0];
  best.evidence.unseen = gain.unseen[0];
  best.parameters = gain.parameters;
}

// takes the shape when it gains more than what stands
void offer(Evidence const& evidence, std::vector<double> const& shape, DrivenBy motion, RefinedCandidate& best) {
  Effect const& effect = *best.evidence.scan.effect;
  if (!effect.is_plausible(shape, evidence.columns().scales())) return;
  LawGain const gain = evidence.gains(effect, {shape}, best.evidence.folds, motion).front();
  if (!gain.is_testable) return;
  double const total = gain.total()[0];
  if (total <= best.evidence.scan.gain) {
    if (motion == DrivenBy::recording) best.other_shapes.push_back(shape);
    return;
  }
  if (motion == DrivenBy::recording) best.other_shapes.push_back(best.shape);
  take(gain, best);
  best.shape = shape;
  best.driven_by = motion;
}

}  // namespace

namespace {

RefinedCandidate with_refined_shape(Evidence const& evidence, CandidateEvidence const& law,
                                    RefinementSetting const& setting) {
  RefinedCandidate best{law, {}, law.scan.effect->parameters().size(), law.scan.shape, law.scan.parameters};
  Effect const& effect = *law.scan.effect;
  // the scan looked at fewer samples; what all of them cannot tell from the model gains nothing
  LawGain const of_all = evidence.gains(effect, {law.scan.shape}, law.folds).front();
  if (of_all.is_testable)
    take(of_all, best);
  else
    best.evidence.scan.gain = best.evidence.train = best.evidence.unseen = 0.0;
  if (effect.n_shape() == 0) return best;
  Eigen::VectorXd const mismatch = evidence.stage().mismatch();
  ShapeSearch const search = shape_search(setting.optimiser, setting.seed);
  RefinedEffect const refined = refine_shape(evidence.columns(), law.scan, mismatch, search, setting.threads);
  best.evaluations += refined.evaluations;
  offer(evidence, refined.shape, DrivenBy::twin, best);
  if (!effect.has_memory()) return best;
  OwnMotionShapes shapes(evidence.columns(DrivenBy::recording), law.scan, mismatch, setting.optimiser, setting.seed,
                         setting.threads);
  auto const own = setting.everywhere && effect.has_inertia() ? shapes.everywhere() : shapes.nearby();
  if (!own) return best;
  best.evaluations += own->evaluations;
  offer(evidence, own->shape, DrivenBy::recording, best);
  return best;
}

// the variant at another shape
void move_to(Evidence const& evidence, std::vector<double> shape, RefinedCandidate& law) {
  Effect const& effect = *law.evidence.scan.effect;
  LawGain const gain = evidence.gains(effect, {shape}, law.evidence.folds, law.driven_by).front();
  law.left = evidence.rows_left(effect, shape, law.evidence.folds, law.driven_by);
  law.shape = std::move(shape);
  take(gain, law);
  law.other_shapes.clear();
}

// without a shape that leaves no clearly more when it is not there
void simplify(Evidence const& evidence, RefinedCandidate& law) {
  Effect const& effect = *law.evidence.scan.effect;
  auto const bounds = effect.shape_bounds(evidence.columns().scales());
  for (std::size_t k = 0; k < law.shape.size(); ++k) {
    if (!effect.parameters()[effect.n_linear() + k].none_at_lower) continue;
    std::vector<double> shape = law.shape;
    shape[k] = bounds[k].lower;
    if (!effect.is_plausible(shape, evidence.columns().scales())) continue;
    LawGain const gain = evidence.gains(effect, {shape}, law.evidence.folds, law.driven_by).front();
    if (!gain.is_testable || !(gain.total()[0] > 0.0)) continue;
    if (leaves_clearly_less(law.left, evidence.rows_left(effect, shape, law.evidence.folds, law.driven_by))) continue;
    --law.n_parameters;
    move_to(evidence, std::move(shape), law);
  }
}

}  // namespace

InsideBounds inside_bounds(Evidence const& evidence, Effect const& effect, std::vector<double> shape,
                           Eigen::VectorXd const& linear, FoldKind folds, DrivenBy motion) {
  constexpr double further_inside = 0.1;  // of the range
  JointScales const& scales = evidence.columns().scales();
  InsideBounds result{std::move(shape), {}};
  for (std::size_t k = 0; k < effect.n_shape(); ++k) {
    auto const bound = reached_bound(effect, result.shape, linear, scales);
    if (!bound) return result;
    result.bound = bound;
    if (bound->parameter < effect.n_linear()) return result;
    std::size_t const at = bound->parameter - effect.n_linear();
    std::vector<double> moved = result.shape;
    moved[at] = from_unit(effect.shape_bounds(scales)[at],
                          bound->side == BoundSide::lower ? further_inside : 1.0 - further_inside);
    if (!effect.is_plausible(moved, scales)) return result;
    RowsLeft const there = evidence.rows_left(effect, result.shape, folds, motion),
                   inside = evidence.rows_left(effect, moved, folds, motion);
    if (leaves_clearly_less(there, inside)) return result;
    result = {std::move(moved), {}};
  }
  return result;
}

RefinedCandidate refined_candidate(Evidence const& evidence, CandidateEvidence const& law,
                                   RefinementSetting const& setting) {
  RefinedCandidate best = with_refined_shape(evidence, law, setting);
  best.left = evidence.rows_left(*law.scan.effect, best.shape, law.folds, best.driven_by);
  simplify(evidence, best);
  InsideBounds inside =
      inside_bounds(evidence, *law.scan.effect, best.shape, best.parameters, law.folds, best.driven_by);
  if (inside.shape != best.shape) move_to(evidence, std::move(inside.shape), best);
  best.bound = inside.bound;
  // where a refined shape cannot be simulated the grid's may
  if (best.shape != law.scan.shape) best.other_shapes.push_back(law.scan.shape);
  return best;
}

namespace {

// Where the first is a law of the position like a spring, the weight of the link goes before it: every link has one
void put_weight_first(std::vector<RefinedCandidate>::iterator first, std::vector<RefinedCandidate>::iterator last) {
  if (first == last || first->evidence.scan.effect->family() != EffectFamily::static_position) return;
  auto const weight =
      std::find_if(first, last, [](RefinedCandidate const& one) { return one.evidence.scan.effect->is_weight(); });
  if (weight != last) std::rotate(first, weight, weight + 1);
}

}  // namespace

std::vector<RefinedCandidate> in_order(std::vector<RefinedCandidate> candidates, RowsLeft const& without_any,
                                       double tolerance) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](auto const& a, auto const& b) { return a.evidence.scan.gain > b.evidence.scan.gain; });
  if (candidates.empty()) return candidates;
  RowsLeft const best = candidates.front().left;
  auto const tied = std::stable_partition(candidates.begin(), candidates.end(), [&](RefinedCandidate const& one) {
    return !leaves_clearly_more(one.left, best, {without_any, tolerance});
  });
  std::stable_sort(candidates.begin(), tied, [](auto const& a, auto const& b) {
    bool const a_once = is_clock_bound(*a.evidence.scan.effect), b_once = is_clock_bound(*b.evidence.scan.effect);
    return a_once != b_once ? b_once : a.n_parameters < b.n_parameters;
  });
  put_weight_first(candidates.begin(), tied);
  return candidates;
}

}  // namespace torquescope
