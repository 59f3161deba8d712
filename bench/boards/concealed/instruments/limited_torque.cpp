// A converter whose range is too small, and not centred.
#include <algorithm>

#include "concealed/instruments/faults.hpp"

namespace concealed {
namespace {

class LimitedTorque final : public Instrument {
 public:
  LimitedTorque(double lowest, double highest) : lowest_(lowest), highest_(highest) {}
  double torque(double, double motor, double*) const override { return std::clamp(motor, lowest_, highest_); }

 private:
  double lowest_, highest_;
};

}  // namespace

Fault limited_torque(double lowest, double highest) { return std::make_shared<LimitedTorque>(lowest, highest); }

}  // namespace concealed
