// A supply without a brake resistor: what the drive took from it or fed back a while ago decides what it can give now.
//
// State      sag of the supply, share of its voltage; below zero after feeding back
// Equation   d(sag)/dt = (motor v / power - sag) / memory; the joint gets motor (1 - share sag)
#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class SupplySag final : public HiddenEffect {
 public:
  SupplySag(double share, double power, double memory_s) : share_(share), power_(power), memory_s_(memory_s) {}
  std::size_t n_states() const override { return 1; }
  void rates(Instant const& now, double const* z, double* dz) const override {
    dz[0] = (now.motor * now.v / power_ - z[0]) / memory_s_;
  }
  double torque(Instant const& now, double const* z) const override { return now.motor * share_ * z[0]; }

 private:
  double share_, power_, memory_s_;
};

}  // namespace

Effect supply_sag(double share, double power, double memory_s) {
  return std::make_shared<SupplySag>(share, power, memory_s);
}

}  // namespace concealed
