#include "engine/simulate/loop_law.hpp"

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

}  // namespace torquescope
