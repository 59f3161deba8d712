// Friction of a cold joint, falling with two time constants: grease near the teeth first, the housing later.
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class WarmUp final : public HiddenEffect {
 public:
  WarmUp(double coulomb, double viscous, double fast_s, double slow_s)
      : coulomb_(coulomb), viscous_(viscous), fast_s_(fast_s), slow_s_(slow_s) {}
  double torque(Instant const& now, double const*) const override { return viscous_ * cold(now.t) * now.v; }
  double dry(Instant const& now, double const*) const override { return coulomb_ * cold(now.t); }

 private:
  double cold(double t) const { return 0.6 * std::exp(-t / fast_s_) + 0.4 * std::exp(-t / slow_s_); }
  double coulomb_, viscous_, fast_s_, slow_s_;
};

}  // namespace

Effect warm_up(double coulomb, double viscous, double share, double fast_s, double slow_s) {
  return std::make_shared<WarmUp>(share * coulomb, share * viscous, fast_s, slow_s);
}

}  // namespace concealed
