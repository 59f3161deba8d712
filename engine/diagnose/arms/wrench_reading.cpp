#include "engine/diagnose/arms/wrench_reading.hpp"

#include <utility>

#include "engine/diagnose/arms/setup_fit.hpp"
#include "engine/diagnose/arms/setup_search.hpp"

namespace torquescope {

WrenchFit fit_wrench(ArmSamples const& samples, SerialChain const& chain) {
  BaseParameters const base(chain, DriveInertias::included);
  ArmSetup const setup = setup_as_read(chain);
  Eigen::MatrixXd const motors = samples.tau - samples.outside;
  Eigen::VectorXd const size = samples.tau.colwise().norm().transpose();
  ArmSamples trial = samples;
  // all relative to one torque, or a reading with larger torques would look better
  auto const error_of = [&](Eigen::MatrixXd const& outside) -> Eigen::VectorXd {
    trial.tau = motors + outside;
    Eigen::VectorXd const error = fit_of(trial, setup, base).error;
    return error.cwiseProduct(trial.tau.colwise().norm().transpose()).cwiseQuotient(size.cwiseMax(1e-300));
  };
  WrenchFit fit;
  fit.without = error_of(0.0 * samples.outside);
  fit.as_written = error_of(samples.outside);
  fit.at_best = fit.as_written;
  std::pair<WrenchReading, Eigen::MatrixXd> const others[] = {
      {WrenchReading::other_side, -samples.outside},
      {WrenchReading::other_frame, samples.outside_otherwise},
      {WrenchReading::other_side_and_frame, -samples.outside_otherwise}};
  for (auto const& [reading, outside] : others) {
    Eigen::VectorXd const error = error_of(outside);
    // no error is too small to be halved: the readings are few, and no other mistake looks like one of them
    if (!halves_one(fit.as_written, fit.as_written, error, 0.0, {})) continue;
    if (fit.best != WrenchReading::as_written && !(error.sum() < fit.at_best.sum())) continue;
    fit.best = reading;
    fit.at_best = error;
  }
  return fit;
}

}  // namespace torquescope
