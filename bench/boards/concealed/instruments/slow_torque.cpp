// Torque channels that are slower than their rows: behind a filter, or refreshed only now and then.
#include <cmath>
#include <numbers>

#include "concealed/instruments/faults.hpp"

namespace concealed {
namespace {

class FilteredTorque final : public Instrument {
 public:
  explicit FilteredTorque(double keep) : keep_(keep) {}
  std::size_t n_memory() const override { return 1; }
  double torque(double, double motor, double* memory) const override {
    memory[0] = keep_ * memory[0] + (1.0 - keep_) * motor;
    return memory[0];
  }

 private:
  double keep_;
};

class HeldTorque final : public Instrument {
 public:
  explicit HeldTorque(int n_ticks) : n_ticks_(n_ticks) {}
  std::size_t n_memory() const override { return 2; }  // ticks until the next refreshing, value
  double torque(double, double motor, double* memory) const override {
    if (memory[0] <= 0.0) {
      memory[0] = n_ticks_;
      memory[1] = motor;
    }
    memory[0] -= 1.0;
    return memory[1];
  }

 private:
  int n_ticks_;
};

}  // namespace

Fault filtered_torque(double cutoff_hz, double tick_s) {
  return std::make_shared<FilteredTorque>(std::exp(-2.0 * std::numbers::pi * cutoff_hz * tick_s));
}
Fault held_torque(int n_ticks) { return std::make_shared<HeldTorque>(n_ticks); }

}  // namespace concealed
