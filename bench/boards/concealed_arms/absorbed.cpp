#include "concealed_arms/absorbed.hpp"

#include <Eigen/QR>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "concealed_arms/rigid_columns.hpp"

namespace concealed_arms {
namespace {

constexpr int reach = 50;  // rows on either side
constexpr int decimation = 10;
constexpr double band_hz = 10.0;

Eigen::VectorXd low_pass() {
  double const pi = std::numbers::pi, w = 2.0 * pi * band_hz * log_every * control_s;
  Eigen::VectorXd taps(2 * reach + 1);
  for (int k = -reach; k <= reach; ++k)
    taps[reach + k] = (k == 0 ? w : std::sin(w * k) / k) * (1.0 + std::cos(pi * k / (reach + 1.0)));
  return taps / taps.sum();
}

bool one_way(Eigen::MatrixXd const& v, int joint, Eigen::Index row) {
  auto const window = v.row(joint).segment(row - reach, 2 * reach + 1).array();
  return (window > 0.0).all() || (window < 0.0).all();
}

// rows of all joints below one another, weighed; whose row it is stands in `joint`
struct FilteredRows {
  Eigen::MatrixXd columns;
  Eigen::VectorXd torque;
  std::vector<int> joint;
};

FilteredRows filtered_rows(Arm const& arm, ArmRun const& run, Eigen::MatrixXd const& torque,
                           Eigen::VectorXd const& zeros) {
  int const n = arm.joints(), width = 14 * n;
  Eigen::VectorXd const taps = low_pass();
  std::vector<Eigen::MatrixXd> at_row;
  for (Eigen::Index row = 0; row < run.q.cols(); ++row)
    at_row.push_back(torque_columns(arm, upright, run.q.col(row) + zeros, run.v.col(row), run.a.col(row)));
  FilteredRows rows;
  auto const most = n * (run.q.cols() / decimation);
  rows.columns.resize(most, width);
  rows.torque.resize(most);
  Eigen::Index used = 0;
  for (Eigen::Index row = reach; row + reach < run.q.cols(); row += decimation) {
    Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(n, width);
    for (int k = -reach; k <= reach; ++k) mean += taps[reach + k] * at_row[static_cast<std::size_t>(row + k)];
    for (int j = 0; j < n; ++j) {
      if (!one_way(run.v, j, row)) continue;
      rows.columns.row(used) = mean.row(j);
      rows.torque[used++] = torque.row(j).segment(row - reach, 2 * reach + 1).dot(taps);
      rows.joint.push_back(j);
    }
  }
  rows.columns.conservativeResize(used, width);
  rows.torque.conservativeResize(used);
  return rows;
}

}  // namespace

Left left_after_fit(Arm const& arm, ArmRun const& run, Eigen::MatrixXd const& torque, Eigen::VectorXd const& zeros) {
  int const n = arm.joints();
  FilteredRows const rows = filtered_rows(arm, run, torque, zeros);
  double const gain = low_pass().norm();  // of white noise
  Left left{Eigen::VectorXd::Zero(n), Eigen::VectorXd(n), Eigen::VectorXd::Zero(n)};
  Eigen::VectorXd weight(rows.torque.size()), count = Eigen::VectorXd::Zero(n);
  for (int j = 0; j < n; ++j) left.noise_rms[j] = gain * arm.links[static_cast<std::size_t>(j)].noise;
  for (Eigen::Index i = 0; i < weight.size(); ++i)
    weight[i] = 1.0 / left.noise_rms[rows.joint[static_cast<std::size_t>(i)]];
  // columns of equal size; those that say nothing or the same as others get no parameter of their own
  Eigen::MatrixXd weighed = weight.asDiagonal() * rows.columns;
  for (Eigen::Index k = 0; k < weighed.cols(); ++k)
    if (double const size = weighed.col(k).norm(); size > 0.0) weighed.col(k) /= size;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit;
  fit.setThreshold(1e-7);
  fit.compute(weighed);
  Eigen::VectorXd const wanted = weight.cwiseProduct(rows.torque);
  Eigen::VectorXd const residual = (wanted - weighed * fit.solve(wanted)).cwiseQuotient(weight);
  for (Eigen::Index i = 0; i < weight.size(); ++i) {
    int const j = rows.joint[static_cast<std::size_t>(i)];
    left.residual_rms[j] += residual[i] * residual[i];
    left.torque_rms[j] += rows.torque[i] * rows.torque[i];
    count[j] += 1.0;
  }
  if (count.minCoeff() < 50.0) throw std::runtime_error("a joint of the arm hardly moves");
  left.residual_rms = left.residual_rms.cwiseQuotient(count).cwiseSqrt();
  left.torque_rms = left.torque_rms.cwiseQuotient(count).cwiseSqrt();
  return left;
}

}  // namespace concealed_arms
