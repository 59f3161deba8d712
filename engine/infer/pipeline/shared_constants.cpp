#include "engine/infer/pipeline/shared_constants.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/dense_solvers.hpp"
#include "engine/data/levels.hpp"

namespace torquescope {
namespace {

// but for the few rows of the other direction that a joint which sticks and jumps leaves
bool is_constant(Eigen::VectorXd const& column) {
  double const mean = column.mean();
  double const spread = std::sqrt((column.array() - mean).square().mean());
  return spread <= levels::spread_of_constant() * std::abs(mean);
}

// what least squares gives the column beside the ones that are told apart
double fitted(ProcessedRecord const& prepared, std::vector<Eigen::Index> columns, Eigen::Index column) {
  columns.push_back(column);
  Eigen::MatrixXd const x = prepared.columns(Eigen::all, columns);
  Eigen::VectorXd const theta = solve_pivoted(x, prepared.torque);
  return theta[theta.size() - 1];
}

// of the velocity, beside dry friction that stands for them at one speed
std::vector<std::string> terms_of_velocity(Regressor const& regressor) {
  std::vector<std::string> names;
  bool has_dry_friction = false;
  auto const& owners = regressor.column_owners();
  for (auto const& owner : owners) {
    Effect const* term = regressor.terms()[owner.term];
    has_dry_friction = has_dry_friction || term->is_dry_friction();
    if (owner.needs_velocity && !term->is_dry_friction() && term->n_linear() == 1) names.push_back(term->name());
  }
  return has_dry_friction ? names : std::vector<std::string>{};
}

}  // namespace

std::vector<std::string> terms_to_drop(Regressor const& regressor, ProcessedRecord const& prepared,
                                       bool has_one_speed) {
  if (prepared.kept_rows.size() <= regressor.size()) return {};  // too few to say anything of
  struct Constant {
    Effect const* term;
    Eigen::Index column;
  };
  std::vector<Constant> constants;
  std::vector<Eigen::Index> others;
  std::vector<std::string> dropped = has_one_speed ? terms_of_velocity(regressor) : std::vector<std::string>{};
  auto const& owners = regressor.column_owners();
  for (std::size_t k = 0; k < owners.size(); ++k) {
    auto const at = static_cast<Eigen::Index>(k);
    Effect const* term = regressor.terms()[owners[k].term];
    if (std::find(dropped.begin(), dropped.end(), term->name()) != dropped.end()) continue;
    bool const is_absent = prepared.columns.col(at).isZero(0.0);  // friction of the direction that is not there
    if (term->n_linear() == 1 && !term->is_given() && (is_absent || is_constant(prepared.columns.col(at))))
      constants.push_back({term, at});
    else
      others.push_back(at);
  }
  if (constants.size() < 2) return dropped;
  auto const stands_for_all = [&](Constant const& one) {
    bool const is_there = !prepared.columns.col(one.column).isZero(0.0);
    return is_there && one.term->is_dry_friction() &&
           one.term->torque({.dq = prepared.motion.dq.mean()},
                            std::vector<double>{fitted(prepared, others, one.column)}, {}) *
                   prepared.motion.dq.mean() >
               0.0;
  };
  auto kept = std::find_if(constants.begin(), constants.end(), stands_for_all);
  if (kept == constants.end())
    kept =
        std::find_if(constants.begin(), constants.end(), [](auto const& one) { return !one.term->is_dry_friction(); });
  if (kept == constants.end()) kept = constants.begin();
  for (auto one = constants.begin(); one != constants.end(); ++one)
    if (one != kept) dropped.push_back(one->term->name());
  return dropped;
}

}  // namespace torquescope
