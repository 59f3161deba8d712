// Viscous friction that differs between the directions.
#include <cmath>

#include "concealed/effects/laws.hpp"

namespace concealed {
namespace {

class AsymmetricViscous final : public HiddenEffect {
 public:
  explicit AsymmetricViscous(double drag) : drag_(drag) {}
  double torque(Instant const& now, double const*) const override { return drag_ * std::abs(now.v); }

 private:
  double drag_;
};

}  // namespace

Effect asymmetric_viscous(double drag) { return std::make_shared<AsymmetricViscous>(drag); }

}  // namespace concealed
