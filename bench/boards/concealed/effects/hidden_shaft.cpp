// An unbalanced shaft of another drive that this joint drags along through a slipping belt: periodic neither in the
// time nor in the angle.
//
// State      angle of the shaft
// Equation   d(angle)/dt = 2 pi hz (1 + 0.3 sin(2 pi t / 11 s)) + drag v; torque = amplitude (sin angle + 0.3 sin 2
//            angle)
#include <cmath>

#include "concealed/effects/laws.hpp"
#include "concealed/one_turn.hpp"

namespace concealed {
namespace {

constexpr double hunting_s = 11.0, hunting = 0.3;

class HiddenShaft final : public HiddenEffect {
 public:
  HiddenShaft(double amplitude, double hz, double drag) : amplitude_(amplitude), hz_(hz), drag_(drag) {}
  std::size_t n_states() const override { return 1; }
  void rates(Instant const& now, double const*, double* dz) const override {
    dz[0] = one_turn * hz_ * (1.0 + hunting * std::sin(one_turn * now.t / hunting_s)) + drag_ * now.v;
  }
  double torque(Instant const&, double const* z) const override {
    return amplitude_ * (std::sin(z[0]) + 0.3 * std::sin(2.0 * z[0]));
  }

 private:
  double amplitude_, hz_, drag_;
};

}  // namespace

Effect hidden_shaft(double amplitude, double hz, double drag) {
  return std::make_shared<HiddenShaft>(amplitude, hz, drag);
}

}  // namespace concealed
