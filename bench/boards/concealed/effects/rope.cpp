// A hose or bundle of cables led past a guide: slack near its rest, then taut, rubbing on itself as it bends.
//
// State      z in (-1, 1), how far the strands are shifted against each other
// Equation   length = sqrt(guide^2 + x^2), tension = stiffness (length - slack_length)+, torque = tension x / length +
//            rub z dz/dx = (1 - z |z| sign(dx)) / distance; x = q - rest
#include <algorithm>
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class Rope final : public HiddenEffect {
 public:
  explicit Rope(RopeDesign const& design) : d_(design) {}
  std::size_t n_states() const override { return 1; }
  void rates(Instant const& now, double const* z, double* dz) const override {
    double const side = now.v > 0.0 ? 1.0 : -1.0;
    dz[0] = now.v * (1.0 - side * z[0] * std::abs(z[0])) / d_.distance;
  }
  double torque(Instant const& now, double const* z) const override {
    double const x = now.q - d_.rest, length = std::hypot(d_.guide, x);
    return d_.stiffness * std::max(0.0, length - d_.slack_length) * x / length + d_.rub * z[0];
  }

 private:
  RopeDesign d_;
};

}  // namespace

Effect rope(RopeDesign const& design) { return std::make_shared<Rope>(design); }

}  // namespace concealed
