#include "engine/search/generic_axes.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/statistics/hat_functions.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index n_knots = 12;
constexpr Eigen::Index n_knots_of_two = 8;

Eigen::MatrixXd times(Eigen::MatrixXd basis, Eigen::VectorXd const& factor) {
  basis.array().colwise() *= factor.array();
  return basis;
}

Eigen::MatrixXd tensor(Eigen::VectorXd const& x, Eigen::VectorXd const& y) {
  Eigen::MatrixXd const a = hats(x, n_knots_of_two), b = hats(y, n_knots_of_two);
  Eigen::MatrixXd out(x.size(), a.cols() * b.cols());
  for (Eigen::Index i = 0; i < a.cols(); ++i)
    for (Eigen::Index j = 0; j < b.cols(); ++j) out.col(i * b.cols() + j) = a.col(i).cwiseProduct(b.col(j));
  return out;
}

class Shares {
 public:
  Shares(CandidateColumns const& columns, double excess) : columns_(columns), excess_(excess) {
    auto const& rows = columns.comparison().rows;
    mismatch_ = rows.residual - rows.twin_mean;
    apart_ = rows.twins.colwise() - rows.twin_mean;
  }

  void add(std::string name, std::vector<SignatureAxis> axes, Eigen::MatrixXd basis) {
    Eigen::Index const width = basis.cols();
    OrthonormalGroup const group = orthonormal_group(std::move(basis), columns_.nuisance(),
                                                     std::vector<bool>(static_cast<std::size_t>(width), false));
    auto const m = static_cast<double>(apart_.cols());
    double const noise = (group.q.transpose() * apart_).squaredNorm() / (m - 1.0);
    double const gain = (group.q.transpose() * mismatch_).squaredNorm() / (1.0 + 1.0 / m) - noise;
    axes_.push_back({std::move(name), std::move(axes), gain / excess_});
  }

  std::vector<GenericAxis> sorted() && {
    std::stable_sort(axes_.begin(), axes_.end(), [](auto const& a, auto const& b) { return a.share > b.share; });
    return std::move(axes_);
  }

 private:
  CandidateColumns const& columns_;
  double excess_;
  Eigen::VectorXd mismatch_;
  Eigen::MatrixXd apart_;
  std::vector<GenericAxis> axes_;
};

}  // namespace

std::vector<GenericAxis> generic_axes(CandidateColumns const& columns, double excess) {
  TORQUESCOPE_EXPECT(excess > 0.0);
  auto const& rows = columns.comparison().rows;
  Eigen::VectorXd const s = rows.dq.array().sign();
  using enum SignatureAxis;
  Shares shares(columns, excess);
  shares.add("position", {position}, hats(rows.q, n_knots));
  shares.add("velocity", {velocity}, hats(rows.dq, n_knots));
  shares.add("acceleration", {acceleration}, hats(rows.ddq, n_knots));
  shares.add("time", {time}, hats(rows.time_s, n_knots));
  shares.add("friction over position", {position}, times(hats(rows.q, n_knots), s));
  shares.add("drag over position", {position}, times(hats(rows.q, n_knots), rows.dq));
  shares.add("inertia over position", {position}, times(hats(rows.q, n_knots), rows.ddq));
  shares.add("friction over time", {time}, times(hats(rows.time_s, n_knots), s));
  shares.add("drag over time", {time}, times(hats(rows.time_s, n_knots), rows.dq));
  shares.add("inertia over time", {time}, times(hats(rows.time_s, n_knots), rows.ddq));
  shares.add("load", {load}, hats(rows.load_torque, n_knots));
  shares.add("friction over load", {load}, times(hats(rows.load_torque, n_knots), s));
  shares.add("distance since reversal", {since_velocity_reversal},
             times(hats(rows.since_velocity_reversal, n_knots), s));
  shares.add("position and velocity", {position, velocity}, tensor(rows.q, rows.dq));
  shares.add("velocity and acceleration", {velocity, acceleration}, tensor(rows.dq, rows.ddq));
  return std::move(shares).sorted();
}

}  // namespace torquescope
