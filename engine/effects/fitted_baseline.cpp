#include "engine/effects/fitted_baseline.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// 0 when the model has no such parameter
double parameter_named(Regressor const& regressor, std::span<double const> parameters, std::string const& name) {
  auto const names = regressor.names();
  auto const found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? 0.0 : parameters[static_cast<std::size_t>(found - names.begin())];
}

// torque of the dry terms alone in one direction
double dry_torque(Regressor const& regressor, std::span<double const> parameters, double direction) {
  double sum = 0.0;
  std::size_t first = 0;
  for (auto const* term : regressor.terms()) {
    auto const own = parameters.subspan(first, term->n_linear());
    if (term->is_dry_friction()) sum += term->torque({.dq = direction}, own, {});
    first += term->n_linear();
  }
  return sum;
}

}  // namespace

JointScales measure_scales(Motion const& motion, JointKind joint, double cutoff_hz, double encoder_step,
                           Eigen::VectorXd const* gear_load) {
  TORQUESCOPE_EXPECT(gear_load == nullptr || gear_load->size() == motion.torque.size());
  Eigen::VectorXd const torque = gear_load == nullptr ? motion.torque : (motion.torque + *gear_load).eval();
  TORQUESCOPE_EXPECT(motion.q.size() >= 2 && motion.rate_hz > 0.0 && cutoff_hz > 0.0 && encoder_step >= 0.0);
  JointScales scales;
  scales.joint = joint;
  scales.start_s = motion.time_s[0];
  scales.duration_s = motion.time_s[motion.time_s.size() - 1] - motion.time_s[0];
  scales.rate_hz = motion.rate_hz;
  scales.cutoff_hz = cutoff_hz;
  scales.peak_speed = motion.dq.cwiseAbs().maxCoeff();
  scales.position_range = motion.q.maxCoeff() - motion.q.minCoeff();
  scales.position_centre = 0.5 * (motion.q.maxCoeff() + motion.q.minCoeff());
  scales.encoder_step = encoder_step;
  scales.torque_rms = std::sqrt(torque.squaredNorm() / static_cast<double>(torque.size()));
  scales.torque_peak = torque.cwiseAbs().maxCoeff();
  scales.torque_highest = std::max(0.0, torque.maxCoeff());
  scales.torque_lowest = std::max(0.0, -torque.minCoeff());
  return scales;
}

FittedBaseline fitted_baseline(Regressor const& regressor, std::span<double const> parameters, Motion const& motion,
                               double cutoff_hz, double encoder_step, BesideMotion const& beside) {
  TORQUESCOPE_EXPECT(parameters.size() == regressor.size());
  FittedBaseline baseline;

  // a Coulomb level of the wrong sign is an offset in disguise, not friction
  auto& scales = baseline.scales = measure_scales(motion, regressor.joint(), cutoff_hz, encoder_step, beside.gear_load);
  scales.coulomb_positive = std::max(0.0, dry_torque(regressor, parameters, 1.0));
  scales.coulomb_negative = std::max(0.0, -dry_torque(regressor, parameters, -1.0));
  scales.inertia = parameter_named(regressor, parameters, "inertia");
  scales.viscous = parameter_named(regressor, parameters, "viscous");
  scales.gravity_sin = parameter_named(regressor, parameters, "gravity_sin");
  scales.gravity_cos = parameter_named(regressor, parameters, "gravity_cos");

  Eigen::MatrixXd const phi = regressor.columns(motion, beside.given);
  baseline.load_torque.setZero(phi.rows());
  baseline.model_torque.setZero(phi.rows());
  scales.bears_only_inertia = true;
  for (std::size_t k = 0; k < regressor.size(); ++k) {
    auto const& column = regressor.column_owners()[k];
    Eigen::VectorXd const torque = parameters[k] * phi.col(static_cast<Eigen::Index>(k));
    baseline.model_torque += torque;
    if (column.needs_position || column.needs_acceleration) baseline.load_torque += torque;
    if (column.needs_position) scales.bears_only_inertia = false;
  }
  if (beside.gear_load != nullptr) {
    baseline.model_torque += *beside.gear_load;
    baseline.load_torque += *beside.gear_load;
  }
  return baseline;
}

}  // namespace torquescope
