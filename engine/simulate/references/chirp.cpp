// A sine whose frequency rises linearly from band_hz[0] to band_hz[1] over the recording.
//
// Equation   p(t) = sin(2 pi (f_0 t + (f_1 - f_0) t^2 / (2 T)))

#include <algorithm>
#include <numbers>

#include "engine/simulate/ramped.hpp"
#include "engine/simulate/references/reference_choice.hpp"
#include "engine/simulate/turns.hpp"

namespace torquescope {

namespace {

class Chirp : public Reference {
 public:
  Chirp(double from_hz, double to_hz, double duration_s) : from_hz_(from_hz), slope_((to_hz - from_hz) / duration_s) {}

  ReferencePoint at(double time_s) const override {
    double const turns = (from_hz_ + 0.5 * slope_ * time_s) * time_s;
    double const omega = 2.0 * std::numbers::pi * (from_hz_ + slope_ * time_s);
    double const sine = sine_of_turns(turns);
    double const cosine = cosine_of_turns(turns);
    return {sine, omega * cosine, 2.0 * std::numbers::pi * slope_ * cosine - omega * omega * sine};
  }

 private:
  double from_hz_, slope_;
};

}  // namespace

std::unique_ptr<Reference const> make_chirp(ReferenceOptions const& options, double duration_s, RandomKey const&) {
  double const from_hz = options.band_hz[0];
  double const to_hz = options.band_hz[1];
  return ramped_to_limits(std::make_unique<Chirp>(from_hz, to_hz, duration_s), std::max(from_hz, to_hz), duration_s,
                          options);
}

}  // namespace torquescope
