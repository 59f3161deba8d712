#include "engine/simulate/encoder.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/contract.hpp"

namespace torquescope {

OptionTable<EncoderOptions> const& EncoderOptions::table() {
  constexpr double unlimited = std::numeric_limits<double>::max();
  using O = EncoderOptions;
  static OptionTable<EncoderOptions> const options(
      "simulate.encoder", "how finely the position is measured; exact when neither key is given",
      {{"counts_per_revolution", &O::counts_per_revolution, "1", 0.0, unlimited,
        "steps per turn of the joint, gear and interpolation included"},
       {"step", &O::step, "rad or m", 0.0, unlimited, "size of one step, instead of counts_per_revolution"}});
  return options;
}

Encoder::Encoder(EncoderOptions const& options)
    : step_(options.counts_per_revolution > 0.0 ? 2.0 * std::numbers::pi / options.counts_per_revolution
                                                : options.step) {
  TORQUESCOPE_EXPECT(options.counts_per_revolution == 0.0 || options.step == 0.0);
}

double Encoder::read(double position) const {
  if (step_ == 0.0) return position;
  return step_ * std::floor(position / step_ + 0.5);
}

}  // namespace torquescope
