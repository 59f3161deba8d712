// Torques that follow from a potential of the position: an eccentric weight, a spring that hardens.
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class Gravity final : public HiddenEffect {
 public:
  Gravity(double torque, double angle) : torque_(torque), angle_(angle) {}
  double torque(Instant const& now, double const*) const override { return torque_ * std::sin(now.q - angle_); }

 private:
  double torque_, angle_;
};

class HardeningSpring final : public HiddenEffect {
 public:
  HardeningSpring(double stiffness, double rest, double hardening)
      : stiffness_(stiffness), rest_(rest), hardening_(hardening) {}
  double torque(Instant const& now, double const*) const override {
    double const x = now.q - rest_;
    return stiffness_ * x * (1.0 + hardening_ * x * x);
  }

 private:
  double stiffness_, rest_, hardening_;
};

}  // namespace

Effect gravity(double torque, double angle) { return std::make_shared<Gravity>(torque, angle); }
Effect hardening_spring(double stiffness, double rest, double hardening) {
  return std::make_shared<HardeningSpring>(stiffness, rest, hardening);
}

}  // namespace concealed
