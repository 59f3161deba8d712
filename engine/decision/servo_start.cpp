#include "engine/decision/servo_start.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

struct Row {
  double command, position, speed, acceleration, known;
};

double known_torque(TrackKnown const& known, double position, double acceleration) {
  return known.gravity_moment * std::sin(position) + known.inertia * acceleration;
}

void add_rows(RolloutTrack const& track, LoopNumbers const& loop, std::vector<Row>& rows) {
  constexpr double span_s = 0.05;
  Index const span = std::max<Index>(1, std::llround(span_s * track.rate_hz));
  double const apart_s = static_cast<double>(span) / track.rate_hz;
  double const most = std::min(loop.most, track.known.command_limit);
  for (auto const& segment : track.segments)
    for (Index k = segment.first + span; k + span < segment.first + segment.samples; ++k) {
      if (track.enabled.size() > 0 && track.enabled[k] == 0.0) continue;
      double const before = track.position[k - span], here = track.position[k], after = track.position[k + span];
      Row row{};
      row.command = std::clamp(loop.kp * track.known.command_gain * (track.reference[k] - here), -most, most);
      row.position = here;
      row.speed = (after - before) / (2.0 * apart_s);
      row.acceleration = (after - 2.0 * here + before) / (apart_s * apart_s);
      row.known = known_torque(track.known, here, row.acceleration);
      rows.push_back(row);
    }
}

double sign_of(double speed) { return speed > 0.0 ? 1.0 : speed < 0.0 ? -1.0 : 0.0; }

}  // namespace

ServoStart servo_start(Regressor const& regressor, LoopSetting const& loop, std::vector<RolloutTrack> const& tracks) {
  constexpr Index n_known = 7;  // gain, inertia, damping, dry friction, offset, and weight by sine and cosine
  auto const& terms = regressor.terms();
  bool const has_weight = std::any_of(terms.begin(), terms.end(), [](auto* one) { return one->name() == "gravity"; });
  LoopNumbers const numbers = numbers_of(loop.form, loop.values);
  ServoStart start;
  start.terms = Eigen::VectorXd::Zero(static_cast<Index>(regressor.size()));
  std::vector<Row> rows;
  double largest_inertia = 0.0;
  for (auto const& track : tracks) {
    add_rows(track, numbers, rows);
    largest_inertia = std::max(largest_inertia, track.known.inertia);
    start.fixes_scale = start.fixes_scale || track.known.gravity_moment != 0.0 || track.known.inertia != 0.0;
  }
  auto const n = static_cast<Index>(rows.size());
  Index const first = start.fixes_scale ? 0 : 1;
  Index const last = has_weight ? n_known : n_known - 2;
  Eigen::MatrixXd columns(n, last - first);
  Eigen::VectorXd wanted(n);
  for (Index k = 0; k < n; ++k) {
    Row const& row = rows[static_cast<std::size_t>(k)];
    double const all[n_known] = {row.command,
                                 -row.acceleration,
                                 -row.speed,
                                 -sign_of(row.speed),
                                 -1.0,
                                 -std::sin(row.position),
                                 -std::cos(row.position)};
    for (Index i = first; i < last; ++i) columns(k, i - first) = all[i];
    wanted[k] = start.fixes_scale ? row.known : -row.command;
  }
  if (n < 2 * n_known) return start;
  auto const fit = solve_pivoted(columns, wanted);
  double const command_rms = columns.col(0).norm(), known_rms = wanted.norm();
  if (start.fixes_scale)
    start.motor_gain = fit[0] > 0.0 || command_rms == 0.0 ? std::max(fit[0], 0.0) : known_rms / command_rms;
  // least squares of what missing physics bends: no joint is driven by its friction or has no inertia
  constexpr double tenth = 0.1, hundredth = 1e-2;
  double const inertia = fit[1 - first], least_inertia = std::max(tenth * largest_inertia, 1e-6);
  start.damping = std::max(fit[2 - first], 0.0);
  double const friction = std::max(fit[3 - first], hundredth * known_rms / std::sqrt(static_cast<double>(n)));
  Index at = 0;
  for (auto const* term : regressor.terms()) {
    std::string const name = term->name();
    if (name == "inertia") start.terms[at] = std::max(inertia, least_inertia);
    if (name == "viscous") start.terms[at] = 0.5 * start.damping;
    if (name == "coulomb") start.terms[at] = friction;
    if (name == "offset") start.terms[at] = fit[4 - first];
    if (name == "gravity") start.terms.segment(at, 2) = fit.segment(5 - first, 2);
    at += static_cast<Index>(term->n_linear());
  }
  return start;
}

}  // namespace torquescope
