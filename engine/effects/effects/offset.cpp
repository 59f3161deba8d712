// Constant torque: sensor or current offset, asymmetric Coulomb friction, weight on a slide.
//
// Equation   tau = b
// Source     Gautier 1997, Dynamic identification of robots with power model

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Offset final : public InstantEffect {
 public:
  Offset()
      : InstantEffect({.name = "offset",
                       .title = "constant offset",
                       .equation = "b",
                       .source = "Gautier 1997, Dynamic identification of robots with power model",
                       .parameters = {{"offset", "N m", "N"}},
                       .signature = {SignatureAxis::position},
                       .parity = Parity::even,
                       .code = "offset"}) {}

 private:
  void evaluate(JointStates const&, std::span<double const>, JointScales const&, EffectColumns out) const override {
    out.col(0) = 1.0;
  }
};

}  // namespace

Effect const& offset() {
  static Offset const effect;
  return effect;
}

}  // namespace torquescope::effects
