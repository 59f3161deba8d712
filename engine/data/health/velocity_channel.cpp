#include "engine/data/health/velocity_channel.hpp"

#include <algorithm>
#include <numeric>

#include "engine/data/known_factors.hpp"

namespace torquescope {
namespace {

struct Pair {
  std::vector<double> derivative, velocity;  // at the same rows, in the units of the job
  double step_s = 0.0;
};

std::vector<double> averaged(std::vector<double> const& values, std::size_t half) {
  std::vector<double> sums(values.size() + 1, 0.0);
  std::partial_sum(values.begin(), values.end(), sums.begin() + 1);
  std::vector<double> means;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::size_t const from = i >= half ? i - half : 0, until = std::min(values.size(), i + half + 1);
    means.push_back((sums[until] - sums[from]) / static_cast<double>(until - from));
  }
  return means;
}

// over rows where both are known; a hundredth of a second, or three rows, are averaged
Pair compared(Examination& exam) {
  constexpr double averaged_s = 0.01;
  auto const& q = exam.values("position");
  auto const& v = exam.values("velocity");
  Pair pair;
  std::size_t const n = q.size();
  pair.step_s = (exam.time_s.back() - exam.time_s.front()) / static_cast<double>(n - 1);
  double last_derivative = 0.0, last_velocity = 0.0;
  std::vector<double> derivative, velocity;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    double const seconds = exam.time_s[i + 1] - exam.time_s[i - 1];
    double const slope = seconds > 0.0 ? (q[i + 1] - q[i - 1]) / seconds * exam.options.position_per_unit : 0.0;
    if (std::isfinite(slope)) last_derivative = slope;
    if (std::isfinite(v[i])) last_velocity = v[i] * exam.options.velocity_factor();
    derivative.push_back(last_derivative);
    velocity.push_back(last_velocity);
  }
  auto const half = static_cast<std::size_t>(std::max(1.0, std::round(averaged_s / pair.step_s / 2)));
  pair.derivative = averaged(derivative, half);
  pair.velocity = averaged(velocity, half);
  return pair;
}

struct Likeness {
  double correlation = 0.0;  // without the means
  double gain = 0.0;         // velocity over derivative, least squares
};

// of velocity[i + lag] with derivative[i]
Likeness likeness(Pair const& pair, std::ptrdiff_t lag) {
  auto const n = static_cast<std::ptrdiff_t>(pair.velocity.size());
  double sd = 0, sv = 0, dd = 0, vv = 0, dv = 0, count = 0;
  for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, -lag); i < std::min(n, n - lag); ++i) {
    double const d = pair.derivative[static_cast<std::size_t>(i)], v = pair.velocity[static_cast<std::size_t>(i + lag)];
    sd += d, sv += v, dd += d * d, vv += v * v, dv += d * v, ++count;
  }
  double const cdd = dd - sd * sd / count, cvv = vv - sv * sv / count, cdv = dv - sd * sv / count;
  if (!(cdd > 0.0) || !(cvv > 0.0)) return {};
  return {cdv / std::sqrt(cdd * cvv), cdv / cdd};
}

// the lag at which they are most alike, in rows, between rows by a parabola
double best_lag(Pair const& pair, double sign) {
  constexpr double longest_s = 0.2;
  auto const reach =
      static_cast<std::ptrdiff_t>(std::min(longest_s / pair.step_s, 0.1 * static_cast<double>(pair.velocity.size())));
  std::ptrdiff_t best = 0;
  double most = -2.0;
  for (std::ptrdiff_t lag = -reach; lag <= reach; ++lag) {
    double const now = sign * likeness(pair, lag).correlation;
    if (now > most) {
      most = now;
      best = lag;
    }
  }
  if (best == -reach || best == reach) return static_cast<double>(best);
  double const left = sign * likeness(pair, best - 1).correlation, right = sign * likeness(pair, best + 1).correlation;
  double const bend = left - 2 * most + right;
  return static_cast<double>(best) + (bend < 0.0 ? 0.5 * (left - right) / bend : 0.0);
}

// gain: velocity over derivative
std::string factor_words(double gain) {
  constexpr double same = 0.03;
  if (auto const* unit = nearest_known(speed_factors(), 1.0 / gain, same)) return unit->words;
  if (auto const* unit = nearest_known(angle_factors(), gain, same)) return "a position in " + unit->words;
  return {};
}

void leave_out(Examination& exam) {
  exam.channels.erase("velocity");
  exam.channels.erase("acceleration");
}

}  // namespace

void examine_velocity(Examination& exam) {
  if (!exam.has("velocity")) return;
  std::string const column = exam.channels.at("velocity").column;
  auto const say = [&](FindingKind kind, double size, std::string detail = {}) {
    exam.add(kind, Grade::warning, Repair::channel_unused, "velocity", {}, size, std::move(detail));
    leave_out(exam);
  };
  auto const known = known_rows(exam.values("velocity"));
  auto const& values = exam.values("velocity");
  bool const is_constant = known.empty() || std::all_of(known.begin(), known.end(), [&](std::size_t row) {
                             return values[row] == values[known.front()];
                           });
  if (is_constant) return say(FindingKind::velocity_constant, known.empty() ? 0.0 : values[known.front()]);
  if (exam.rows() < 64) return;

  // the same signal, but for an encoder's noise, has a correlation near one at its own lag
  constexpr double same = 0.9, same_gain = 0.05;
  Pair const pair = compared(exam);
  Likeness const now = likeness(pair, 0);
  double const sign = now.correlation < 0.0 ? -1.0 : 1.0;
  double const lag = best_lag(pair, sign);
  Likeness const then = likeness(pair, std::llround(lag));
  if (std::fabs(then.correlation) < same) return say(FindingKind::velocity_contradicts, now.correlation);
  if (then.gain < 0.0 || std::fabs(then.gain - 1.0) > same_gain)
    return say(FindingKind::velocity_factor, then.gain, factor_words(then.gain));
  // a row is how far channels of one log may be apart; what a lag costs is its part of the torque, and two rows or
  // two thousandths of a second are already more than a filter of the drive should have
  constexpr double rows_apart = 1.5, seconds_apart = 0.002;
  if (std::fabs(lag) > rows_apart && std::fabs(lag) * pair.step_s > seconds_apart)
    return say(FindingKind::velocity_late, lag * pair.step_s);
}

}  // namespace torquescope
