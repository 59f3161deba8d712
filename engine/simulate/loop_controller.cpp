#include "engine/simulate/loop_controller.hpp"

namespace torquescope {

double LoopController::proportional_gain() const {
  double sum = 0.0;
  for (double gain : position) sum -= gain;
  return sum;
}

double LoopController::velocity_gain(double rate_hz) const {
  // q_(k-i) = q_k - i v / rate
  double sum = 0.0;
  for (std::size_t i = 0; i < position.size(); ++i) sum += static_cast<double>(i) * position[i];
  return sum / rate_hz;
}

Eigen::VectorXd open_part(LoopController const& controller, Eigen::VectorXd const& reference,
                          Eigen::VectorXd const& gear_load) {
  ReferenceSignal const signal(reference);
  Eigen::VectorXd open(reference.size());
  for (Eigen::Index k = 0; k < open.size(); ++k) {
    open[k] = controller.constant;
    for (std::size_t j = 0; j < controller.reference.size(); ++j)
      open[k] +=
          controller.reference[j] * signal(k + controller.shift - controller.behind + static_cast<Eigen::Index>(j));
    for (auto const& term : controller.terms) open[k] += term.gain * term(signal, k);
    if (gear_load.size() > 0)
      open[k] += controller.gear_load[0] * gear_load[k] + controller.gear_load[1] * step_after(gear_load, k);
  }
  return open;
}

}  // namespace torquescope
