#include "engine/simulate/loop_law.hpp"

#include <numbers>

#include "engine/base/contract.hpp"

namespace torquescope {

double LoopLaw::proportional_gain() const {
  double sum = 0.0;
  for (double gain : position) sum -= gain;
  return sum;
}

double LoopLaw::velocity_gain(double rate_hz) const {
  // q_(k-i) = q_k - i v / rate
  double sum = 0.0;
  for (std::size_t i = 0; i < position.size(); ++i) sum += static_cast<double>(i) * position[i];
  return sum / rate_hz;
}

LoopLaw tracking_law(double inertia, double bandwidth_hz, double rate_hz) {
  TORQUESCOPE_EXPECT(inertia > 0.0 && bandwidth_hz > 0.0 && bandwidth_hz <= 0.05 * rate_hz);
  double const omega = 2.0 * std::numbers::pi * bandwidth_hz;
  double const kp = inertia * omega * omega;
  double const kd = 2.0 * inertia * omega * rate_hz;  // per difference of one sample
  double const ahead = inertia * rate_hz * rate_hz;   // per second difference
  LoopLaw law;
  law.position = {-kp - kd, kd};
  law.reference = {-0.5 * kd + ahead, kp - 2.0 * ahead, 0.5 * kd + ahead};
  return law;
}

}  // namespace torquescope
