#include "engine/decision/loop_moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/effects/carry_over.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

bool can_be_simulated(Effect const& law, Regressor const& regressor) {
  auto const& terms = regressor.terms();
  return !law.is_given() && !law.is_of_whole_arm() && !law.is_torque_timing() &&
         std::find(terms.begin(), terms.end(), &law) == terms.end();
}

}  // namespace

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

namespace {

// share of the positive numbers below it
double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double one) { return !(one > 0.0) || !std::isfinite(one); });
  if (values.empty()) return 0.0;
  auto const place = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place), values.end());
  return values[place];
}

// how fast the joints move, by differences over a twentieth of a second, which an encoder's steps hardly show in
struct Pace {
  double speed = 0.0, acceleration = 0.0;
};

Pace pace_of(std::vector<RolloutTrack> const& tracks) {
  constexpr double span_s = 0.05, nearly_all = 0.98;
  std::vector<double> speeds, accelerations;
  for (auto const& track : tracks) {
    Index const span = std::max<Index>(1, std::llround(span_s * track.rate_hz));
    double const apart_s = static_cast<double>(span) / track.rate_hz;
    for (auto const& segment : track.segments)
      for (Index k = segment.first + span; k + span < segment.first + segment.samples; ++k) {
        double const before = track.position[k - span], here = track.position[k], after = track.position[k + span];
        speeds.push_back(std::abs(after - before) / (2.0 * apart_s));
        accelerations.push_back(std::abs(after - 2.0 * here + before) / (apart_s * apart_s));
      }
  }
  return {quantile(std::move(speeds), nearly_all), quantile(std::move(accelerations), nearly_all)};
}

}  // namespace

std::vector<LoopMove> law_moves(DecisionFacts const& scan, Regressor const& regressor, JointScales const& scales,
                                DecisionNumbers const& numbers) {
  std::vector<LoopMove> moves;
  auto const has = [&](Effect const* law) {
    return std::any_of(moves.begin(), moves.end(), [&](LoopMove const& one) { return one.subject.effect == law; });
  };
  for (auto const& law : scan.accepted)
    if (can_be_simulated(*law.effect, regressor) && (law.effect->is_wave() || !has(law.effect)))
      moves.push_back(law_move(*law.effect, law.shape, scales));
  std::vector<double> const unknown;
  std::size_t const most = moves.size() + numbers.refined;
  auto const add = [&](Effect const* law, std::vector<double> const& shape) {
    if (moves.size() < most && !is_clock_bound(*law) && can_be_simulated(*law, regressor) && !has(law))
      moves.push_back(law_move(*law, shape, scales));
  };
  for (auto const& law : scan.accepted)
    for (auto const* rival : law.rivals) add(rival, unknown);
  for (auto const& step : scan.steps)
    for (auto const& law : step.laws)
      if (law.p <= numbers.alpha) add(law.effect, law.shape);
  // the rows may be blind to what a simulation shows: where few are left, those that gain most
  constexpr std::size_t fewest = 3;
  if (!scan.steps.empty())
    for (auto const& law : scan.steps.front().laws)
      if (moves.size() < fewest && law.gain > 0.0) add(law.effect, law.shape);
  return moves;
}

std::vector<LoopMove> command_moves(LoopSetting const& loop, std::vector<RolloutTrack> const& training) {
  using enum LoopKey;
  std::vector<LoopMove> moves;
  if (loop.form == LoopForm::identified || loop.form == LoopForm::none) return moves;
  Pace const pace = pace_of(training);
  double const sample_s = 1.0 / training.front().rate_hz;
  auto const add = [&](LoopKey key, std::vector<double> const& starts) {
    bool const is_free = std::find(loop.free.begin(), loop.free.end(), key) != loop.free.end();
    if (is_free || loop.values[key] != facts_of(key).none) return;
    LoopMove move{{nullptr, key}, {}};
    for (double const start : starts)
      if (start > facts_of(key).least && start < facts_of(key).most) move.starts.push_back({start});
    if (!move.starts.empty()) moves.push_back(std::move(move));
  };
  add(goal_speed_limit, {0.5 * pace.speed, 0.7 * pace.speed, 0.9 * pace.speed, 1.1 * pace.speed});
  add(goal_acceleration_limit,
      {0.25 * pace.acceleration, 0.5 * pace.acceleration, pace.acceleration, 2.0 * pace.acceleration});
  add(command_delay_s, {0.5 * sample_s, 2.0 * sample_s, 0.02, 0.06});
  return moves;
}

}  // namespace torquescope
