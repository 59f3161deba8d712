// A zero that settles while the amplifier warms up and jumps once.
#include <cmath>

#include "concealed/instruments/faults.hpp"

namespace concealed {
namespace {

class CreepingZero final : public Instrument {
 public:
  CreepingZero(double creep, double settle_s, double jump, double jump_s)
      : creep_(creep), settle_s_(settle_s), jump_(jump), jump_s_(jump_s) {}
  double torque(double t, double motor, double*) const override {
    return motor + creep_ * -std::expm1(-t / settle_s_) + (t >= jump_s_ ? jump_ : 0.0);
  }

 private:
  double creep_, settle_s_, jump_, jump_s_;
};

}  // namespace

Fault creeping_zero(double creep, double settle_s, double jump, double jump_s) {
  return std::make_shared<CreepingZero>(creep, settle_s, jump, jump_s);
}

}  // namespace concealed
