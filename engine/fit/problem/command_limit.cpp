#include "engine/fit/problem/command_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/dense_solvers.hpp"
#include "engine/data/levels.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr Index levels_tried = 16, rounds = 2;
// convention: a drive at its limits for more than half of the time (a third at either), or less than one row in 500, is
// another problem: a torque that is nearly the sign of the speed is all beyond some level
constexpr double most_beyond = 0.5, most_on_a_side = 0.33, least_beyond = 0.002;
// convention: an error that falls by a third is worth a sentence; the filters bend the kink by a sixth at most
constexpr double error_falls = 1.5, about_one = 0.2;
// convention: share of what kinks at three levels explain that the limit alone must
constexpr double alone = 0.9;

// convention: share (rms) of what is asked beyond the limit that the motion must leave. A model with many columns
// explains any part of a measured torque nearly as well as the whole; the motion knows nothing of what never acted
constexpr double least_foreign = 0.1;

enum Side { up, down };

// what is asked for beyond a level, which is infinite where that side has no limit
VectorXd beyond(VectorXd const& torque, Side side, double level) {
  if (!std::isfinite(level)) return VectorXd::Zero(torque.size());
  if (side == up) return (torque.array() - level).max(0.0);
  return (torque.array() - level).min(0.0);
}

struct Kinks {
  double upper = no_limit, lower = -no_limit;
  double energy = 0.0;  // explained
};

class Scan {
 public:
  Scan(TorqueBesideMotion const& beside, VectorXd const& torque) : beside_(beside), torque_(torque) {}

  VectorXd column(Side side, double level) const {
    return beside_.left_of(beside_.filtered(beyond(torque_, side, level)));
  }
  // the best pair of these levels, or the best single one
  Kinks best(std::vector<double> const& uppers, std::vector<double> const& lowers) const {
    std::vector<VectorXd> const a = columns(up, uppers), b = columns(down, lowers);
    VectorXd const& left = beside_.left();
    Kinks best;
    auto const keep = [&](double energy, double upper, double lower) {
      if (energy > best.energy) best = {upper, lower, energy};
    };
    for (std::size_t i = 0; i < a.size(); ++i) keep(alone_energy(a[i], left), uppers[i], -no_limit);
    for (std::size_t j = 0; j < b.size(); ++j) keep(alone_energy(b[j], left), no_limit, lowers[j]);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j) {
        double const aa = a[i].squaredNorm(), bb = b[j].squaredNorm(), ab = a[i].dot(b[j]);
        double const x = a[i].dot(left), y = b[j].dot(left), determinant = aa * bb - ab * ab;
        if (determinant > 1e-12 * aa * bb)
          keep((bb * x * x - 2 * ab * x * y + aa * y * y) / determinant, uppers[i], lowers[j]);
      }
    return best;
  }

 private:
  static double alone_energy(VectorXd const& column, VectorXd const& left) {
    double const length = column.squaredNorm(), along = column.dot(left);
    return length > 0.0 ? along * along / length : 0.0;
  }
  std::vector<VectorXd> columns(Side side, std::vector<double> const& levels) const {
    std::vector<VectorXd> all;
    for (double const level : levels) all.push_back(column(side, level));
    return all;
  }

  TorqueBesideMotion const& beside_;
  VectorXd const& torque_;
};

std::vector<double> between(double first, double last, Index count) {
  std::vector<double> all;
  for (Index k = 0; k < count; ++k)
    all.push_back(first + (last - first) * static_cast<double>(k) / static_cast<double>(count - 1));
  return all;
}

// levels beyond which these shares of the rows lie, from most to least: a command may ask for many times the limit
std::vector<double> levels_of(std::vector<double> const& sorted, Side side) {
  std::vector<double> all;
  double const last = static_cast<double>(sorted.size() - 1);
  for (Index k = 0; k < levels_tried; ++k) {
    double const share =
        most_on_a_side * std::pow(least_beyond / most_on_a_side, static_cast<double>(k) / (levels_tried - 1.0));
    all.push_back(sorted[static_cast<std::size_t>((side == up ? 1.0 - share : share) * last)]);
  }
  return all;
}

// finer levels from the neighbour on one side to that on the other; none where there is no level
std::vector<double> around(double level, std::vector<double> const& tried) {
  constexpr Index finer = 9;
  auto const at = std::find(tried.begin(), tried.end(), level);
  if (at == tried.end()) return {};
  return between(at == tried.begin() ? *at : *std::prev(at), std::next(at) == tried.end() ? *at : *std::next(at),
                 finer);
}

enum class Sides { both, upper, lower };

// the best on levels that grow finer around it; none where a level nearer to zero might explain more: what bends at the
// border of the scan is the torque as a whole, not a level of it
Kinks scanned(Scan const& scan, std::vector<double> const& sorted, Sides sides) {
  std::vector<double> uppers, lowers;
  if (sides != Sides::lower) uppers = levels_of(sorted, up);
  if (sides != Sides::upper) lowers = levels_of(sorted, down);
  Kinks best = scan.best(uppers, lowers);
  if (std::isfinite(best.upper) && best.upper == uppers.front()) return {};
  if (std::isfinite(best.lower) && best.lower == lowers.front()) return {};
  for (Index round = 0; round < rounds; ++round) {
    uppers = around(best.upper, uppers), lowers = around(best.lower, lowers);
    best = scan.best(uppers, lowers);
  }
  return best;
}

MatrixXd columns_at(Scan const& scan, Kinks const& kinks, Index rows) {
  MatrixXd columns(rows, 0);
  auto const add = [&](Side side, double level) {
    if (!std::isfinite(level)) return;
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.rightCols(1) = scan.column(side, level);
  };
  add(up, kinks.upper);
  add(down, kinks.lower);
  return columns;
}

// a side without which the other explains as much as with it
bool has_idle_side(Scan const& scan, Kinks const& best, VectorXd const& left, double rows) {
  if (!std::isfinite(best.upper) || !std::isfinite(best.lower)) return false;
  double const all = left.squaredNorm();
  for (Kinks const& one : {Kinks{best.upper, -no_limit}, Kinks{no_limit, best.lower}}) {
    double const energy = energy_within(left, columns_at(scan, one, left.size()));
    if (!levels::is_larger_beyond_chance(std::sqrt(all - energy), std::sqrt(all - best.energy), rows)) return true;
  }
  return false;
}

// kinks half way to the middle of the torque and half way to its end beside the limit
double energy_of_more_kinks(Scan const& scan, Kinks const& kinks, VectorXd const& torque, VectorXd const& left) {
  MatrixXd columns = columns_at(scan, kinks, left.size());
  auto const half_way = [](double level, double end) { return 0.5 * (level + end); };  // NaN where there is no level
  double const middle = torque.mean();
  Kinks const inner{half_way(kinks.upper, middle), half_way(kinks.lower, middle)};
  Kinks const outer{half_way(kinks.upper, torque.maxCoeff()), half_way(kinks.lower, torque.minCoeff())};
  for (auto const& more : {inner, outer}) {
    MatrixXd const beside = columns_at(scan, more, left.size());
    columns.conservativeResize(Eigen::NoChange, columns.cols() + beside.cols());
    columns.rightCols(beside.cols()) = beside;
  }
  return energy_within(left, columns);
}

bool is_foreign_to_the_motion(TorqueBesideMotion const& beside, VectorXd const& torque, Kinks const& found,
                              VectorXd const& explained) {
  VectorXd const asked = beside.filtered(beyond(torque, up, found.upper) + beyond(torque, down, found.lower));
  return explained.norm() >= least_foreign * asked.norm();
}

Index count_beyond(VectorXd const& torque, Kinks const& found) {
  return (torque.array() > found.upper).count() + (torque.array() < found.lower).count();
}

bool is_limit(TorqueBesideMotion const& beside, Scan const& scan, Kinks const& found, VectorXd const& torque) {
  VectorXd const& left = beside.left();
  // a drive pushes either way: one that never does would hold the joint at its stop
  if (found.upper <= 0.0 || found.lower >= 0.0) return false;
  if (static_cast<double>(count_beyond(torque, found)) > most_beyond * static_cast<double>(torque.size())) return false;
  double const all = left.squaredNorm(), after = std::max(all - found.energy, 0.0);
  if (!(std::sqrt(all) >= error_falls * std::sqrt(after))) return false;
  MatrixXd const columns = columns_at(scan, found, left.size());
  VectorXd const factors = solve_pivoted(columns, left);
  if (!((factors.array() - 1.0).abs() <= about_one).all()) return false;
  if (!is_foreign_to_the_motion(beside, torque, found, columns * factors)) return false;
  // of the largest among as many levels as were tried
  double const chance =
      levels::chi_squared_beyond_chance + 2.0 * std::log(static_cast<double>(levels_tried * levels_tried));
  double const independent = levels::independent_rows(left - columns * factors);
  if (!(independent * std::log(all / std::max(after, 1e-30 * all)) > chance)) return false;
  return !has_idle_side(scan, found, left, independent) &&
         found.energy >= alone * energy_of_more_kinks(scan, found, torque, left);
}

}  // namespace

std::optional<CommandLimit> command_limit(TorqueBesideMotion const& beside, VectorXd const& torque) {
  VectorXd const& left = beside.left();
  double const all = left.squaredNorm();
  if (!(all > 0.0) || !(torque.maxCoeff() > torque.minCoeff())) return std::nullopt;
  Scan const scan(beside, torque);
  std::vector<double> sorted(torque.begin(), torque.end());
  std::sort(sorted.begin(), sorted.end());
  double of_both = 0.0;
  for (auto const sides : {Sides::both, Sides::upper, Sides::lower}) {
    Kinks const found = scanned(scan, sorted, sides);
    of_both = std::max(of_both, found.energy);
    if (!(found.energy > 0.0) || found.energy < alone * of_both)
      continue;  // a limit on one side leaves nothing to the other
    if (!is_limit(beside, scan, found, torque)) continue;
    CommandLimit limit;
    if (std::isfinite(found.upper)) limit.upper = found.upper;
    if (std::isfinite(found.lower)) limit.lower = found.lower;
    double const torque_norm = beside.torque_rms() * std::sqrt(static_cast<double>(left.size()));
    limit.error_before = std::sqrt(all) / torque_norm;
    limit.error_after = std::sqrt(std::max(all - found.energy, 0.0)) / torque_norm;
    limit.rows = count_beyond(torque, found);
    return limit;
  }
  return std::nullopt;
}

VectorXd limited(VectorXd const& torque, CommandLimit const& limit) {
  VectorXd given = torque;
  if (limit.upper) given = given.array().min(*limit.upper);
  if (limit.lower) given = given.array().max(*limit.lower);
  return given;
}

}  // namespace torquescope
