#include "engine/fit/problem/arm_accuracy.hpp"

#include <cmath>
#include <limits>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

double root_ratio(double part, double whole) {
  return whole > 0.0 ? std::sqrt(part / whole) : std::numeric_limits<double>::quiet_NaN();
}

struct Energies {
  std::vector<double> torque, residual;  // [N]
  std::vector<Eigen::Index> rows;
};

Energies energies_of(RegressionData const& data, Eigen::VectorXd const& parameters) {
  TORQUESCOPE_EXPECT(data.arm.has_value());
  auto const joints = data.arm->joints();
  Energies energies{std::vector<double>(joints, 0.0), std::vector<double>(joints, 0.0),
                    std::vector<Eigen::Index>(joints, 0)};
  for (std::size_t k = 0; k < data.recordings(); ++k) {
    std::size_t const j = data.arm->joint[k];
    double const scale = data.arm->scale[static_cast<Eigen::Index>(j)];
    Eigen::Index const first = data.first_row[k], count = data.first_row[k + 1] - first;
    auto const tau = data.tau.segment(first, count);
    energies.torque[j] += scale * scale * tau.squaredNorm();
    energies.residual[j] += scale * scale * (tau - data.phi.middleRows(first, count) * parameters).squaredNorm();
    energies.rows[j] += count;
  }
  return energies;
}

void add(JointAccuracy& sum, JointAccuracy const& one) {
  sum.rows += one.rows;
  sum.all_rows += one.all_rows;
  sum.torque_energy += one.torque_energy;
  sum.all_torque_energy += one.all_torque_energy;
  sum.residual_energy += one.residual_energy;
  sum.all_residual_energy += one.all_residual_energy;
}

}  // namespace

double JointAccuracy::relerr() const { return root_ratio(residual_energy, torque_energy); }
double JointAccuracy::relerr_all_rows() const { return root_ratio(all_residual_energy, all_torque_energy); }
double JointAccuracy::residual_rms() const { return root_ratio(residual_energy, static_cast<double>(rows)); }

ArmAccuracy arm_accuracy(RegressionData const& moving, RegressionData const& others,
                         Eigen::VectorXd const& parameters) {
  Energies const kept = energies_of(moving, parameters), rest = energies_of(others, parameters);
  ArmAccuracy accuracy;
  for (std::size_t j = 0; j < kept.torque.size(); ++j) {
    JointAccuracy one;
    one.rows = kept.rows[j];
    one.all_rows = kept.rows[j] + rest.rows[j];
    one.torque_energy = kept.torque[j];
    one.all_torque_energy = kept.torque[j] + rest.torque[j];
    one.residual_energy = kept.residual[j];
    one.all_residual_energy = kept.residual[j] + rest.residual[j];
    add(accuracy.arm, one);
    accuracy.joints.push_back(one);
  }
  return accuracy;
}

std::vector<double> arm_relerr(RegressionData const& moving, std::vector<Eigen::VectorXd> const& parameters) {
  std::vector<double> relerr;
  for (auto const& candidate : parameters) {
    Energies const energies = energies_of(moving, candidate);
    double torque = 0.0, residual = 0.0;
    for (std::size_t j = 0; j < energies.torque.size(); ++j) {
      torque += energies.torque[j];
      residual += energies.residual[j];
    }
    relerr.push_back(root_ratio(residual, torque));
  }
  return relerr;
}

}  // namespace torquescope
