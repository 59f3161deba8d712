#include "engine/infer/search/law_discrepancy.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"

namespace torquescope {

double sure_excess(MismatchEnergy const& left) {
  constexpr double one_sided = 1.645;
  return left.excess > 0.0 && left.z > one_sided ? left.excess * (1.0 - one_sided / left.z) : 0.0;
}

namespace {

// of signals among the columns, in coordinates of their span: the triangle of their QR decomposition
class BoundedShift {
 public:
  BoundedShift(Eigen::MatrixXd const& columns, CoefficientBounds const& room, double energy)
      : triangle_(triangle_of(columns)), room_(room), energy_(energy) {
    inverse_ = solve_scaled(triangle_, Eigen::MatrixXd::Identity(triangle_.rows(), triangle_.rows()));
  }

  double largest(Eigen::Index k) const { return std::max(furthest(k, room_.upper[k]), furthest(k, room_.lower[k])); }

 private:
  static Eigen::MatrixXd triangle_of(Eigen::MatrixXd const& columns) {
    TORQUESCOPE_EXPECT(columns.rows() >= columns.cols());
    return torquescope::triangle_of(columns);
  }

  // towards one bound: without the others' it is the first try, theirs can only shorten it
  double furthest(Eigen::Index k, double bound) const {
    constexpr int halvings = 20;
    double const free = std::sqrt(energy_) * inverse_.row(k).norm();
    double inside = 0.0, outside = std::min(free, std::abs(bound));
    if (!(outside > 0.0) || is_affordable(k, std::copysign(outside, bound))) return outside;
    for (int i = 0; i < halvings; ++i) {
      double const middle = 0.5 * (inside + outside);
      (is_affordable(k, std::copysign(middle, bound)) ? inside : outside) = middle;
    }
    return inside;
  }

  // a signal of no more than the energy moves coefficient k there, the others where they want within their bounds
  bool is_affordable(Eigen::Index k, double shift) const {
    constexpr double rounding = 1e-9;
    Eigen::VectorXd const own = shift * triangle_.col(k);
    Eigen::MatrixXd others = triangle_;
    others.col(k).setZero();
    Eigen::VectorXd const rest = own + others * solve_scaled(others, -own, room_);
    return rest.squaredNorm() <= energy_ * (1.0 + rounding);
  }

  Eigen::MatrixXd triangle_, inverse_;
  CoefficientBounds room_;
  double energy_;
};

}  // namespace

Eigen::VectorXd discrepancy_shifts(MismatchEnergy const& left, Eigen::MatrixXd const& columns,
                                   CoefficientBounds const& room) {
  Eigen::VectorXd shifts = Eigen::VectorXd::Zero(columns.cols());
  double const energy = sure_excess(left);
  if (!(energy > 0.0)) return shifts;
  BoundedShift const shift(columns, room, energy);
  for (Eigen::Index k = 0; k < shifts.size(); ++k) shifts[k] = shift.largest(k);
  return shifts;
}

}  // namespace torquescope
