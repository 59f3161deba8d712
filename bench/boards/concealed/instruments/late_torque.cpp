// A torque channel that arrives late over its bus.
#include <algorithm>
#include <cmath>

#include "concealed/instruments/faults.hpp"

namespace concealed {
namespace {

class LateTorque final : public Instrument {
 public:
  explicit LateTorque(double ticks)
      : whole_(static_cast<std::size_t>(std::floor(ticks))), rest_(ticks - std::floor(ticks)) {}
  std::size_t n_memory() const override { return whole_ + 2; }
  double torque(double, double motor, double* memory) const override {
    std::copy_backward(memory, memory + whole_ + 1, memory + whole_ + 2);
    memory[0] = motor;
    return std::lerp(memory[whole_], memory[whole_ + 1], rest_);
  }

 private:
  std::size_t whole_;
  double rest_;
};

}  // namespace

Fault late_torque(double delay_s, double tick_s) { return std::make_shared<LateTorque>(delay_s / tick_s); }

}  // namespace concealed
