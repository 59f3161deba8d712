#include "engine/simulate/rollout/loop_gains.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/dense_solvers.hpp"
#include "engine/simulate/lane_controller.hpp"
#include "engine/simulate/rollout/chunk_inputs.hpp"
#include "engine/simulate/rollout/loop_lanes.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

// what a loop with one gain of 1 answers to the measured positions of a segment, sample by sample
Eigen::VectorXd answer_to(LoopNumbers const& numbers, std::size_t speed_samples, RolloutTrack const& track,
                          TrackSegment const& segment) {
  LaneLoops loops(track.tick_s(), 1, speed_samples);
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) loops.set(lane, numbers);
  double const delay = numbers.command_delay_s / track.tick_s();
  SegmentReference const reference(track, segment);
  double goal[replicate_lanes], read[replicate_lanes], speed[replicate_lanes], held[replicate_lanes],
      logged[replicate_lanes];
  LaneState state;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    state.q[lane] = segment.position;
    state.dq[lane] = segment.velocity;
    goal[lane] = reference.at(-delay);
  }
  LaneLoopState loop;
  loop.start(loops, state, goal, segment.torque);
  Eigen::VectorXd answers(segment.samples);
  for (Index k = 0; k < segment.samples; ++k) {
    Index const at = segment.first + k;
    Index const after = std::min(at + 1, segment.first + segment.samples - 1), before = std::max(at - 1, segment.first);
    double const next = track.position[after];
    std::fill_n(
        speed, replicate_lanes,
        (next - track.position[before]) * track.rate_hz / static_cast<double>(std::max<Index>(1, after - before)));
    for (std::size_t tick = 0; tick < track.ticks_per_sample; ++tick) {
      double const share = static_cast<double>(tick) / static_cast<double>(track.ticks_per_sample);
      std::fill_n(read, replicate_lanes, track.position[at] + share * (next - track.position[at]));
      std::fill_n(goal, replicate_lanes,
                  reference.at(static_cast<double>(k) * static_cast<double>(track.ticks_per_sample) +
                               static_cast<double>(tick) - delay));
      double const added = track.added.size() > 0 ? track.added[at] : 0.0;
      double const enabled = track.enabled.size() > 0 ? track.enabled[at] : 1.0;
      answer_tick(loops, {goal, replicate_lanes, &added, nullptr, &enabled}, 0, read, speed, loop, held, logged);
      if (tick == 0) answers[k] = logged[0];
    }
  }
  return answers;
}

// normal equations of the torque on columns
struct Normal {
  Eigen::MatrixXd gram;
  Eigen::VectorXd right;

  Eigen::VectorXd gains() const { return solve_shortest(gram, right); }
  // [k][columns]: k sums of columns in their place
  Normal of(Eigen::MatrixXd const& sums) const { return {sums * gram * sums.transpose(), sums * right}; }
  double explained() const { return right.dot(gains()); }
};

// on all tracks; columns: numbers with one gain of 1 each. An integral is told up to a constant
Normal normal_of_columns(std::vector<LoopNumbers> const& columns, LoopNumbers const& fixed, std::size_t speed_samples,
                         std::vector<RolloutTrack> const& tracks) {
  constexpr double near_limit = 0.98;
  auto const p = static_cast<Index>(columns.size());
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(p, p);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(p);
  for (auto const& track : tracks) {
    if (track.drive != TrackDrive::reference) continue;
    for (auto const& segment : track.segments) {
      Eigen::MatrixXd phi(segment.samples, p);
      Eigen::VectorXd tau =
          track.torque.segment(segment.first, segment.samples) - answer_to(fixed, speed_samples, track, segment);
      for (Index k = 0; k < p; ++k)
        phi.col(k) = answer_to(columns[static_cast<std::size_t>(k)], speed_samples, track, segment);
      for (Index k = 0; k < segment.samples; ++k) {
        double const asked = std::abs(track.torque[segment.first + k]);
        bool const is_off = track.enabled.size() > 0 && track.enabled[segment.first + k] == 0.0;
        if (asked < near_limit * fixed.most && !is_off) continue;
        phi.row(k).setZero();
        tau[k] = 0.0;
      }
      phi.rowwise() -= phi.colwise().mean().eval();
      tau.array() -= tau.mean();
      gram += phi.transpose() * phi;
      right += phi.transpose() * tau;
    }
  }
  return {gram, right};
}

// u = kv (kp e + s) + ki (integral of kp e + s): {kp, kv, ki} by the kp that explains most of the torque.
// columns: e, s, and the integral of each
std::array<double, 3> cascade_gains(Normal const& normal) {
  constexpr double least = 1e-2, most = 1e5;  // 1/s
  constexpr int n_tried = 200, n_halved = 60;
  auto const at = [&](double kp) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(2, 4);
    sums << kp, 1.0, 0.0, 0.0, 0.0, 0.0, kp, 1.0;
    return normal.of(sums / kp);
  };
  double const apart = std::log(most / least) / n_tried;
  double best = least;
  for (int i = 1; i <= n_tried; ++i) {
    double const kp = least * std::exp(apart * i);
    if (at(kp).explained() > at(best).explained()) best = kp;
  }
  double low = best * std::exp(-apart), high = best * std::exp(apart);
  for (int i = 0; i < n_halved; ++i) {
    double const third = (high - low) / 3.0;
    if (at(low + third).explained() < at(high - third).explained())
      low += third;
    else
      high -= third;
  }
  best = 0.5 * (low + high);
  Eigen::VectorXd const gains = at(best).gains() / best;
  return {best, gains[0], gains[1]};
}

}  // namespace

LoopValues with_first_gains(LoopForm form, LoopValues values, std::vector<LoopKey> const& wanted,
                            std::size_t speed_samples, std::vector<RolloutTrack> const& tracks) {
  using enum LoopKey;
  if (wanted.empty() || gains_of(form).empty()) return values;
  // a loop of no gain: its delays, limits and what is added to its command
  LoopNumbers bare = numbers_of(LoopForm::none, values);
  LoopNumbers empty = bare;
  empty.added_gain = 0.0;
  empty.feed_acceleration = 0.0;
  bool const is_cascade = form == LoopForm::p_velocity || form == LoopForm::p_pi;
  auto const column = [&](double LoopNumbers::*gain) {
    LoopNumbers one = empty;
    one.*gain = 1.0;
    one.least = -std::numeric_limits<double>::infinity();
    one.most = std::numeric_limits<double>::infinity();
    return one;
  };
  std::vector<LoopNumbers> columns{column(&LoopNumbers::kp)};
  bool const has_speed = is_cascade || form == LoopForm::pd || form == LoopForm::pid;
  bool const has_integral = form == LoopForm::pi || form == LoopForm::pid || form == LoopForm::p_pi;
  if (has_speed) columns.push_back(column(&LoopNumbers::kd));
  if (has_integral) columns.push_back(column(&LoopNumbers::ki));
  if (form == LoopForm::p_pi) columns.push_back(column(&LoopNumbers::ki_speed));
  Normal const normal = normal_of_columns(columns, bare, speed_samples, tracks);
  Eigen::VectorXd found = normal.gains();
  if (form == LoopForm::p_pi) {
    auto const [outer, inner, sum] = cascade_gains(normal);
    found << outer * inner, inner, outer * sum, sum;
  }
  constexpr double least_share = 1e-3;
  auto const positive = [&](double gain, double beside) { return std::max(gain, least_share * std::abs(beside)); };
  double const by_error = std::max(found[0], 1e-9), by_speed = has_speed ? positive(found[1], 1e-3 * by_error) : 0.0;
  double const by_integral = has_integral ? positive(found[has_speed ? 2 : 1], by_error) : 0.0;
  auto const set = [&](LoopKey key, double value) {
    if (std::find(wanted.begin(), wanted.end(), key) != wanted.end()) values[key] = value;
  };
  if (is_cascade) {
    set(kv, by_speed);
    set(kp, by_error / values[kv]);
    set(ki, by_integral / values[kp]);
  } else {
    set(kp, by_error);
    set(kd, by_speed);
    set(ki, by_integral);
  }
  return values;
}

namespace {

double share_left(RolloutTrack const& track, std::vector<Eigen::VectorXd> const& answers) {
  double left = 0.0, all = 0.0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    auto const measured = track.torque.segment(track.segments[i].first, track.segments[i].samples);
    left += (measured - answers[i]).squaredNorm();
    all += measured.squaredNorm();
  }
  return all > 0.0 ? std::sqrt(left / all) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double loop_error(LoopNumbers const& numbers, std::size_t speed_samples, RolloutTrack const& track) {
  // without the joint that it would have led, a sum of errors runs away
  if (numbers.ki != 0.0 || numbers.ki_speed != 0.0) return std::numeric_limits<double>::quiet_NaN();
  std::vector<Eigen::VectorXd> answers;
  for (auto const& segment : track.segments) answers.push_back(answer_to(numbers, speed_samples, track, segment));
  return share_left(track, answers);
}

double loop_error(LoopController const& by, RolloutTrack const& track) {
  std::vector<Eigen::VectorXd> answers;
  for (auto const& segment : track.segments) {
    Eigen::VectorXd const reference = track.reference.segment(segment.first, segment.samples);
    Eigen::VectorXd const open = open_part(by, reference);
    ReferenceSignal const signal(reference);
    LaneController controller(by, segment.position, segment.velocity, track.rate_hz);
    answers.emplace_back(segment.samples);
    double read[replicate_lanes], command[replicate_lanes];
    for (Index k = 0; k < segment.samples; ++k) {
      std::fill_n(read, replicate_lanes, track.position[segment.first + k]);
      controller.command(read, open[k], signal(k + by.shift), command);
      answers.back()[k] = command[0];
    }
  }
  return share_left(track, answers);
}

namespace {

// mean square of what the loop leaves of the torque, less what rounding of the measured positions makes of its speed
struct SpanError {
  double mean_square = 0.0, standard_error = 0.0;
};

SpanError error_of_span(LoopNumbers numbers, std::size_t span, std::vector<RolloutTrack> const& tracks) {
  numbers.ki = numbers.ki_speed = 0.0;
  double energy = 0.0, rounding = 0.0, n = 0.0;
  for (auto const& track : tracks) {
    if (track.drive != TrackDrive::reference) continue;
    double torque = 0.0;
    for (auto const& segment : track.segments)
      torque += track.torque.segment(segment.first, segment.samples).squaredNorm();
    auto const samples = static_cast<double>(track.samples());
    double const share = loop_error(numbers, span, track);
    // a difference of two readings, each off by a twelfth of the step squared; within a sample positions are straight
    double const apart =
        std::max(1.0, static_cast<double>(span) / static_cast<double>(track.ticks_per_sample)) / track.rate_hz;
    double const of_rounding = numbers.kd * track.encoder_step / apart;
    energy += share * share * torque;
    rounding += samples * of_rounding * of_rounding / 6.0;
    n += samples;
  }
  return {(energy - rounding) / n, std::sqrt(2.0 / n) * energy / n};
}

}  // namespace

std::size_t speed_span(LoopForm form, LoopValues const& values, std::vector<LoopKey> const& wanted,
                       std::vector<RolloutTrack> const& tracks) {
  constexpr double standard_errors = 3.0;
  std::vector<SpanError> errors;
  for (std::size_t span = 1; span <= most_speed_samples; ++span)
    errors.push_back(
        error_of_span(numbers_of(form, with_first_gains(form, values, wanted, span, tracks)), span, tracks));
  auto const least = std::min_element(errors.begin(), errors.end(),
                                      [](auto const& a, auto const& b) { return a.mean_square < b.mean_square; });
  std::size_t fewest = 0;
  while (errors[fewest].mean_square - standard_errors * errors[fewest].standard_error > least->mean_square) ++fewest;
  return fewest + 1;
}

}  // namespace torquescope
