// Constant torque: sensor or current offset, asymmetric Coulomb friction, weight on a slide.
//
// Equation   tau = b
// Source     Gautier 1997, Dynamic identification of robots with power model

#include "engine/effects/described_effect.hpp"

namespace torquescope::effects {
namespace {

class Offset final : public SingleColumnEffect {
 public:
  Offset()
      : SingleColumnEffect({"offset",
                            "constant offset",
                            "b",
                            "Gautier 1997, Dynamic identification of robots with power model",
                            {{"offset", "N m", "N"}}}) {}

 private:
  double column(JointState const&) const override { return 1.0; }
};

}  // namespace

Effect const& offset() {
  static Offset const effect;
  return effect;
}

}  // namespace torquescope::effects
