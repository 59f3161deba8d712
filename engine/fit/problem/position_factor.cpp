#include "engine/fit/problem/position_factor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/base/dense_solvers.hpp"
#include "engine/data/known_factors.hpp"
#include "engine/data/levels.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index most_rows = 2048;  // what the errors of a few parameters need; a check must not cost a fit

// torque of one unit of each linear parameter of a term
Eigen::VectorXd torque_of(Effect const& term, JointState const& at) {
  auto const n = static_cast<Eigen::Index>(term.n_linear());
  Eigen::VectorXd torque(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(n);
    unit[k] = 1.0;
    torque[k] = term.torque(at, {unit.data(), static_cast<std::size_t>(n)}, {});
  }
  return torque;
}

JointState scaled(JointState at, double factor) {
  at.q *= factor;
  at.dq *= factor;
  at.ddq *= factor;
  return at;
}

bool tells_unit(Effect const& term) {
  // any three instants and any factor do: a power of q gives one ratio for all of them
  constexpr std::array<double, 3> places = {0.3, 0.7, 1.3};
  constexpr double factor = 0.4, rounding = 1e-9;
  auto const n = static_cast<Eigen::Index>(term.n_linear());
  Eigen::MatrixXd before(n, 3), after(n, 3);
  for (std::size_t i = 0; i < places.size(); ++i) {
    JointState const at{.q = places[i], .dq = 1.0 + places[i], .ddq = 2.0 - places[i]};
    before.col(static_cast<Eigen::Index>(i)) = torque_of(term, at);
    after.col(static_cast<Eigen::Index>(i)) = torque_of(term, scaled(at, factor));
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    double const length = before.row(k).squaredNorm();
    if (!(length > 0.0)) continue;
    double const ratio = after.row(k).dot(before.row(k)) / length;
    if ((after.row(k) - ratio * before.row(k)).norm() > rounding * std::sqrt(length)) return true;
  }
  return false;
}

// rows of the fit, those columns that tell no unit, and the instants from which the others are made anew
class Trials {
 public:
  Trials(RegressionData const& data, Regressor const& regressor) {
    Eigen::Index const stride = (data.rows() + most_rows - 1) / most_rows, n = data.rows() / stride;
    auto const dq = data.velocity(), ddq = data.acceleration();
    for (Eigen::Index i = 0; i < n; ++i) {
      auto const row = static_cast<std::size_t>(i * stride);
      at_.push_back({.q = data.q[i * stride], .dq = dq[row], .ddq = ddq[row]});
    }
    auto const every = Eigen::seqN(0, n, stride);
    tau_ = data.tau(every);
    as_written_ = data.phi(every, Eigen::all);
    Eigen::Index column = 0;
    std::vector<Eigen::Index> fixed;
    for (auto const* term : regressor.terms()) {
      auto const size = static_cast<Eigen::Index>(term->n_linear());
      if (tells_unit(*term)) telling_.push_back(term);
      for (Eigen::Index k = 0; k < size; ++k)
        if (!tells_unit(*term)) fixed.push_back(column + k);
      column += size;
    }
    fixed_ = as_written_(Eigen::all, fixed);
  }

  double range() const {
    auto const [least, most] =
        std::minmax_element(at_.begin(), at_.end(), [](auto const& a, auto const& b) { return a.q < b.q; });
    return most->q - least->q;
  }
  Eigen::VectorXd residual_as_written() const { return residual(as_written_); }
  // beside a spring that the model may lack
  double error_beside_spring() const {
    Eigen::MatrixXd phi(as_written_.rows(), as_written_.cols() + 1);
    phi.leftCols(as_written_.cols()) = as_written_;
    for (std::size_t i = 0; i < at_.size(); ++i) phi(static_cast<Eigen::Index>(i), as_written_.cols()) = at_[i].q;
    return residual(phi).norm() / tau_.norm();
  }
  Eigen::VectorXd residual_at(double factor) const {
    Eigen::Index columns = fixed_.cols();
    for (auto const* term : telling_) columns += static_cast<Eigen::Index>(term->n_linear());
    Eigen::MatrixXd phi(fixed_.rows(), columns);
    phi.leftCols(fixed_.cols()) = fixed_;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      Eigen::Index column = fixed_.cols();
      for (auto const* term : telling_) {
        Eigen::VectorXd const torque = torque_of(*term, scaled(at_[i], factor));
        phi.row(static_cast<Eigen::Index>(i)).segment(column, torque.size()) = torque.transpose();
        column += torque.size();
      }
    }
    return residual(phi);
  }
  double error_at(double factor) const { return residual_at(factor).norm() / tau_.norm(); }
  double torque() const { return tau_.norm(); }

 private:
  Eigen::VectorXd residual(Eigen::MatrixXd const& phi) const { return tau_ - phi * solve_pivoted(phi, tau_); }

  std::vector<JointState> at_;
  std::vector<Effect const*> telling_;
  Eigen::VectorXd tau_;
  Eigen::MatrixXd as_written_, fixed_;
};

struct Best {
  double factor = 1.0, error = std::numeric_limits<double>::infinity();
};

// between two neighbours of a grid, by halving towards the smaller error
Best refined(Trials const& trials, double lower, double upper) {
  double const golden = 1.0 / std::numbers::phi;
  constexpr int steps = 24;  // 1e-5 of the way between
  double a = upper - golden * (upper - lower), b = lower + golden * (upper - lower);
  double at_a = trials.error_at(a), at_b = trials.error_at(b);
  for (int k = 0; k < steps; ++k) {
    if (at_a < at_b) {
      upper = b, b = a, at_b = at_a;
      a = upper - golden * (upper - lower), at_a = trials.error_at(a);
    } else {
      lower = a, a = b, at_a = at_b;
      b = lower + golden * (upper - lower), at_b = trials.error_at(b);
    }
  }
  return at_a < at_b ? Best{a, at_a} : Best{b, at_b};
}

// the factor below 1 with which the joint makes a way that joints make; infinite error where none does
Best best_gear(Trials const& trials) {
  constexpr double shortest = 0.5, longest = 4.0 * std::numbers::pi, step = 0.25;  // rad: sin() bends once in a step
  double const range = trials.range();
  Best best;
  for (double way = shortest; way <= std::min(longest, range); way += step)
    if (double const error = trials.error_at(way / range); error < best.error) best = {way / range, error};
  if (!std::isfinite(best.error)) return best;
  return refined(trials, std::max(best.factor - step / range, shortest / range),
                 std::min(best.factor + step / range, 1.0));
}

}  // namespace

bool tells_unit_of_position(Regressor const& regressor) {
  auto const& terms = regressor.terms();
  return std::any_of(terms.begin(), terms.end(), [](Effect const* term) { return tells_unit(*term); });
}

std::optional<PositionFactor> position_factor(RegressionData const& data, Regressor const& regressor) {
  if (data.q.size() != data.rows() || !tells_unit_of_position(regressor)) return std::nullopt;
  Trials const trials(data, regressor);
  double const before = trials.residual_as_written().norm() / trials.torque();
  Best const gear = best_gear(trials);
  Best best = gear;
  KnownFactor const* unit = nullptr;
  for (auto const& known : angle_factors()) {
    if (known.factor < 0.0) continue;
    double const error = trials.error_at(known.factor);
    // a unit stands for a ratio that is no better than chance would make it
    bool const stands_for_ratio =
        std::isfinite(gear.error) &&
        !levels::is_larger_beyond_chance(error, gear.error, levels::independent_rows(trials.residual_at(gear.factor)));
    if ((unit == nullptr && stands_for_ratio) || error < best.error) {
      best = {known.factor, error};
      unit = &known;
    }
  }
  if (!(before >= levels::factor_worth_saying * best.error)) return std::nullopt;
  double const independent = levels::independent_rows(trials.residual_at(best.factor));
  if (!levels::is_larger_beyond_chance(trials.error_beside_spring(), best.error, independent)) return std::nullopt;
  for (double beside : {0.5, 2.0})
    if (!levels::is_larger_beyond_chance(trials.error_at(beside * best.factor), best.error, independent))
      return std::nullopt;
  return PositionFactor{best.factor, unit != nullptr ? unit->words : std::string(), before, best.error};
}

}  // namespace torquescope
