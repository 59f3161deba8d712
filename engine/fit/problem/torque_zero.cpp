#include "engine/fit/problem/torque_zero.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/data/levels.hpp"
#include "engine/fit/statistics/hat_functions.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// convention: a twentieth of the recording before and after a step says where it was
constexpr double least_share_beside = 0.05;
constexpr Index steps_tried = 64, knots_in_time = 7, knots_of_others = 4;
// convention: a zero that explains a quarter of what is left is worth a sentence, where it is off by a hundredth of the
// torque
constexpr double least_explained = 0.25, least_size = 0.01;
// convention: of what any slow change of the zero explains, and of what changes of other things explain beside it
constexpr double nearly_all = 0.8, next_to_nothing = 0.2;

MatrixXd joined(MatrixXd const& a, MatrixXd const& b) { return side_by_side({a, b}); }

// what else may change with time as the zero does: friction, weight, damping, inertia
MatrixXd others_in_time(TorqueBesideMotion const& beside, MatrixXd const& in_time) {
  MatrixXd const& motion = beside.scaled();
  MatrixXd columns(motion.rows(), 0);
  auto const add = [&](VectorXd const& of_motion) {
    columns = joined(columns, in_time.array().colwise() * of_motion.array());
  };
  for (Index k = 0; k < motion.cols(); ++k) add(motion.col(k));
  VectorXd const square = motion.col(1).array().square();
  add(square.array() - square.mean());
  return beside.left_of(columns);
}

VectorXd step_at(VectorXd const& time_s, double at_s) { return (time_s.array() >= at_s).cast<double>(); }

double energy_of(VectorXd const& left, VectorXd const& column) {
  double const length = column.squaredNorm(), along = column.dot(left);
  return length > 1e-9 * static_cast<double>(column.size()) ? along * along / length : 0.0;
}

// coarsely over the rows looked at, then finer and through the filter
class StepScan {
 public:
  StepScan(TorqueBesideMotion const& beside, VectorXd const& time_s) : beside_(beside), time_s_(time_s) {
    double const first = beside.time_s()[0], last = beside.time_s().tail(1)[0],
                 edge = least_share_beside * (last - first);
    first_ = first + edge, last_ = last - edge;
  }

  VectorXd column(double at_s) const { return beside_.left_of(beside_.filtered(step_at(time_s_, at_s))); }

  double best() const {
    double spacing = (last_ - first_) / (steps_tried - 1), at = first_, most = -1.0;
    MatrixXd steps(beside_.left().size(), steps_tried);
    for (Index k = 0; k < steps_tried; ++k)
      steps.col(k) = step_at(beside_.time_s(), first_ + spacing * static_cast<double>(k));
    steps = beside_.left_of(std::move(steps));
    for (Index k = 0; k < steps_tried; ++k)
      if (double const energy = energy_of(beside_.left(), steps.col(k)); energy > most)
        most = energy, at = first_ + spacing * static_cast<double>(k);
    double const sample = time_s_.size() > 1 ? time_s_[1] - time_s_[0] : spacing;
    most = -1.0;
    for (; spacing > 0.5 * sample; spacing *= 0.5) {
      double const middle = at;
      for (double const side : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        double const here = middle + side * spacing;
        double const energy = energy_of(beside_.left(), column(here));
        if (energy > most) most = energy, at = here;
      }
    }
    return at;
  }

 private:
  TorqueBesideMotion const& beside_;
  VectorXd const& time_s_;
  double first_ = 0.0, last_ = 0.0;
};

// in_time: as the rows see it, before the motion was taken out
struct Candidate {
  ZeroChange change;
  MatrixXd in_time, others_in_time;
  VectorXd column;
};

bool is_of_the_zero(TorqueBesideMotion const& beside, Candidate const& one, MatrixXd const& any_zero) {
  VectorXd const& left = beside.left();
  double const all = left.squaredNorm(), energy = energy_of(left, one.column);
  if (energy < least_explained * all) return false;
  if (energy < nearly_all * energy_within(left, joined(one.column, any_zero))) return false;
  MatrixXd const others = others_in_time(beside, one.others_in_time);
  double const together = energy_within(left, joined(one.column, others));
  double const beside_others = together - energy_within(left, others);
  return together - energy <= next_to_nothing * energy && beside_others >= least_explained * all;
}

bool is_beyond_chance(VectorXd const& left, VectorXd const& column, double tried) {
  double const all = left.squaredNorm(), after = all - energy_of(left, column);
  VectorXd const rest = left - column * (column.dot(left) / column.squaredNorm());
  double const chance = levels::chi_squared_beyond_chance + 2.0 * std::log(tried);
  return levels::independent_rows(rest) * std::log(all / std::max(after, 1e-30 * all)) > chance;
}

// Behind a filter the step is known to a few samples; where it stands out of the noise, the torque itself shows it
Index sample_of_step(VectorXd const& torque, Index about, double size) {
  constexpr Index samples_around = 10;
  constexpr double half = 0.5;
  Index best = std::clamp<Index>(about, 1, torque.size() - 1);
  double nearest = half * std::fabs(size);
  for (Index i = std::max<Index>(best - samples_around, 1), last = std::min(best + samples_around, torque.size() - 1);
       i <= last; ++i)
    if (double const differs = std::fabs(torque[i] - torque[i - 1] - size); differs < nearest)
      nearest = differs, best = i;
  return best;
}

}  // namespace

std::optional<TorqueZero> torque_zero(TorqueBesideMotion const& beside, VectorXd const& time_s,
                                      VectorXd const& torque) {
  VectorXd const& left = beside.left();
  VectorXd const& rows_s = beside.time_s();
  double const duration = time_s.tail(1)[0] - time_s[0], middle = 0.5 * (time_s.tail(1)[0] + time_s[0]);
  if (!(duration > 0.0) || !(left.squaredNorm() > 0.0)) return std::nullopt;
  VectorXd const ramp = (rows_s.array() - middle) / duration;
  MatrixXd const any_zero = beside.left_of(hats(rows_s, knots_in_time));
  StepScan const scan(beside, time_s);
  double const at = scan.best();
  Candidate const step{ZeroChange::step, step_at(rows_s, at), joined(step_at(rows_s, at), ramp), scan.column(at)};
  Candidate const drift{ZeroChange::drift, ramp, hats(rows_s, knots_of_others), beside.left_of(ramp)};
  bool const steps = energy_of(left, step.column) >= energy_of(left, drift.column);
  Candidate const& found = steps ? step : drift;
  if (!is_beyond_chance(left, found.column, steps ? static_cast<double>(left.size()) : 1.0)) return std::nullopt;
  if (!is_of_the_zero(beside, found, any_zero)) return std::nullopt;

  TorqueZero zero{found.change, found.column.dot(left) / found.column.squaredNorm()};
  if (std::fabs(zero.size) < least_size * beside.torque_rms()) return std::nullopt;
  zero.explained = energy_of(left, found.column) / left.squaredNorm();
  if (!steps) return zero;
  zero.sample = sample_of_step(torque, (time_s.array() < at).count(), zero.size);
  zero.time_s = time_s[zero.sample];
  return zero;
}

VectorXd zero_error(TorqueZero const& zero, VectorXd const& time_s) {
  if (zero.change == ZeroChange::step) return zero.size * step_at(time_s, zero.time_s);
  double const duration = time_s.tail(1)[0] - time_s[0], middle = 0.5 * (time_s.tail(1)[0] + time_s[0]);
  return zero.size / duration * (time_s.array() - middle);
}

}  // namespace torquescope
