#include "engine/infer/all_rows/loop_moves.hpp"

#include <algorithm>
#include <cmath>

#include "engine/effects/carry_over.hpp"

namespace torquescope {
bool can_be_simulated(Effect const& law, Regressor const& regressor) {
  auto const& terms = regressor.terms();
  return !law.is_given() && !law.is_of_whole_arm() && !law.is_torque_timing() &&
         std::find(terms.begin(), terms.end(), &law) == terms.end();
}

LoopMove law_move(Effect const& law, std::vector<double> const& shape, JointScales const& scales) {
  LoopMove move{{&law}, {}};
  auto const ranges = law.shape_bounds(scales);
  std::vector<double> begin;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    ParameterRange const& range = ranges[k];
    bool const is_logarithmic = range.spacing == Spacing::logarithmic && range.lower > 0.0;
    double const middle = is_logarithmic ? std::sqrt(range.lower * range.upper) : 0.5 * (range.lower + range.upper);
    bool const can_be_none = law.parameters()[law.n_linear() + k].none_at_lower;
    begin.push_back(k < shape.size() ? shape[k] : can_be_none ? range.lower : middle);
  }
  move.starts.push_back(begin);
  if (begin.empty() || law.is_wave()) return move;
  bool const is_logarithmic = ranges[0].spacing == Spacing::logarithmic && ranges[0].lower > 0.0;
  for (double const share : {0.2, 0.4, 0.6, 0.8}) {
    begin[0] = is_logarithmic ? ranges[0].lower * std::pow(ranges[0].upper / ranges[0].lower, share)
                              : ranges[0].lower + share * (ranges[0].upper - ranges[0].lower);
    move.starts.push_back(begin);
  }
  return move;
}

std::vector<LoopMove> law_moves(DecisionFacts const& scan, Regressor const& regressor, JointScales const& scales,
                                DecisionNumbers const& numbers) {
  std::vector<LoopMove> moves;
  auto const has = [&](Effect const* law) {
    return std::any_of(moves.begin(), moves.end(), [&](LoopMove const& one) { return one.subject.effect == law; });
  };
  for (auto const& law : scan.accepted)
    if (can_be_simulated(*law.effect, regressor) && (law.effect->is_wave() || !has(law.effect)))
      moves.push_back(law_move(*law.effect, law.shape, scales));
  std::vector<double> const no_shape;
  std::size_t const most = moves.size() + static_cast<std::size_t>(numbers.refined);
  auto const add = [&](Effect const* law, std::vector<double> const& shape) {
    if (moves.size() < most && !is_clock_bound(*law) && can_be_simulated(*law, regressor) && !has(law))
      moves.push_back(law_move(*law, shape, scales));
  };
  for (auto const& law : scan.accepted)
    for (auto const* rival : law.rivals) add(rival, no_shape);
  for (auto const& step : scan.steps)
    for (auto const& law : step.laws)
      if (law.p <= numbers.alpha) add(law.effect, law.shape);
  return moves;
}

std::vector<DriveLaw const*> drive_laws_of(DriveLawKind kind) {
  std::vector<DriveLaw const*> laws;
  for (DriveLaw const* law : drive_laws())
    if (law->kind == kind) laws.push_back(law);
  return laws;
}

std::vector<LoopMove> drive_moves(LoopSetting const& loop, std::vector<RolloutTrack> const& training,
                                  std::vector<DriveLaw const*> const& laws, bool fits_weight) {
  std::vector<LoopMove> moves;
  if (loop.form == LoopForm::identified || loop.form == LoopForm::none) return moves;
  DriveScales const scales = drive_scales(training, numbers_of(loop.form, loop.values), fits_weight);
  for (DriveLaw const* law : laws) {
    LoopKey const own = law->keys.front();
    bool const is_free = std::find(loop.free.begin(), loop.free.end(), own) != loop.free.end();
    if (is_free || loop.values[own] != facts_of(own).none) continue;
    LoopMove move{{nullptr, own}, {}, law->least_samples * scales.sample_s};
    for (auto const& start : law->starts(scales))
      if (law->adds || (start.front() > facts_of(own).least && start.front() < facts_of(own).most))
        move.starts.push_back(start);
    if (!move.starts.empty()) moves.push_back(std::move(move));
  }
  return moves;
}

}  // namespace torquescope
