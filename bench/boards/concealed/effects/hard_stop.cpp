// A rubber buffer at one end of the travel, hardening like a ball that is pressed flat.
//
// Equation   depth = (q - place)+ on the positive side; torque = stiffness depth^1.5 max(0, 1 + loss d(depth)/dt)
//            (Hunt, Crossley 1975: no jump at contact, never pulls)
#include <algorithm>
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class HardStop final : public HiddenEffect {
 public:
  HardStop(double place, double stiffness, double loss) : place_(place), stiffness_(stiffness), loss_(loss) {}
  double torque(Instant const& now, double const*) const override {
    double const depth = now.q - place_;
    if (depth <= 0.0) return 0.0;
    return stiffness_ * depth * std::sqrt(depth) * std::max(0.0, 1.0 + loss_ * now.v);
  }

 private:
  double place_, stiffness_, loss_;
};

}  // namespace

Effect hard_stop(double place, double stiffness, double loss) {
  return std::make_shared<HardStop>(place, stiffness, loss);
}

}  // namespace concealed
