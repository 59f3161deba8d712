#include "engine/effects/redundancy.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

// quasi-random states (multiples of irrational steps): both directions, never at rest, wide angles
Motion rich_motion() {
  constexpr Eigen::Index n = 200;
  Motion motion;
  motion.rate_hz = 1.0;
  motion.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, n - 1.0);
  motion.q.resize(n);
  motion.dq.resize(n);
  motion.ddq.resize(n);
  auto const spread = [](Eigen::Index i, double step) { return 2.0 * std::fmod(0.5 + double(i) * step, 1.0) - 1.0; };
  for (Eigen::Index i = 0; i < n; ++i) {
    motion.q[i] = 3.0 * spread(i, std::sqrt(2.0));
    motion.dq[i] = 2.0 * spread(i, std::sqrt(3.0)) + 1e-3;
    motion.ddq[i] = 5.0 * spread(i, std::sqrt(5.0));
  }
  motion.torque = Eigen::VectorXd::Zero(n);
  return motion;
}

struct Column {
  std::string name;
  std::string term;
  Eigen::VectorXd values;
};

std::vector<Column> columns_of(std::vector<Effect const*> const& terms) {
  auto const motion = rich_motion();
  std::vector<Column> columns;
  for (auto const* effect : terms) {
    auto const& parameters = effect->parameters();
    Eigen::MatrixXd phi(motion.q.size(), static_cast<Eigen::Index>(effect->n_linear()));
    effect->columns({motion}, {}, phi);
    for (std::size_t k = 0; k < effect->n_linear(); ++k)
      columns.push_back({parameters[k].name, effect->name(), phi.col(static_cast<Eigen::Index>(k))});
  }
  return columns;
}

// "+ 2 offset", "- coulomb"; the first one without "+ "
std::string signed_term(double factor, std::string const& name, bool is_first) {
  std::string const sign = factor < 0.0 ? (is_first ? "-" : " - ") : (is_first ? "" : " + ");
  double const size = std::abs(factor);
  return sign + (std::abs(size - 1.0) < 1e-9 ? name : fmt::format("{:.3g} {}", size, name));
}

}  // namespace

std::vector<Redundancy> find_redundancies(std::vector<Effect const*> const& terms) {
  // far above rounding (1e-15), far below what different columns differ by on the rich motion (> 0.1)
  constexpr double collinear = 1e-9;
  std::vector<Redundancy> found;
  std::vector<Column> independent;
  for (auto const& column : columns_of(terms)) {
    Eigen::MatrixXd earlier(column.values.size(), static_cast<Eigen::Index>(independent.size()));
    for (std::size_t k = 0; k < independent.size(); ++k)
      earlier.col(static_cast<Eigen::Index>(k)) = independent[k].values;
    Eigen::VectorXd factors(earlier.cols());
    if (earlier.cols() > 0) factors = solve_pivoted(earlier, column.values);
    double const rest = earlier.cols() > 0 ? (column.values - earlier * factors).norm() : column.values.norm();
    if (rest > collinear * column.values.norm()) {
      independent.push_back(column);
      continue;
    }
    std::string relation, members = "\"" + column.term + "\"";
    for (std::size_t k = 0; k < independent.size(); ++k) {
      double const factor = factors[static_cast<Eigen::Index>(k)];
      if (std::abs(factor) < collinear) continue;
      relation += signed_term(factor, independent[k].name, relation.empty());
      members += ", \"" + independent[k].term + "\"";
    }
    found.push_back(
        {fmt::format("term \"{}\" says nothing new: {} = {} in every motion", column.term, column.name, relation),
         "remove one of " + members + "; no recording can tell them apart"});
  }
  return found;
}

}  // namespace torquescope
