#include "engine/infer/decision/servo_start.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/dense_solvers.hpp"
#include "engine/simulate/rollout/measured_drive.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

struct Row {
  double command, position, speed, acceleration, known;
};

void add_rows(RolloutTrack const& track, LoopNumbers const& loop, std::vector<Row>& rows) {
  MeasuredDrive const drive = measured_drive(track, loop);
  for (Index k = 0; k < track.position.size(); ++k) {
    if (!is_drive_on(track, k) || !std::isfinite(drive.acceleration[k])) continue;
    double const here = track.position[k], acceleration = drive.acceleration[k];
    double const known = track.known.gravity_moment * std::sin(here) + track.known.inertia * acceleration;
    rows.push_back({drive.command[k], here, drive.speed[k], acceleration, known});
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
