// One sine: p(t) = sin(2 pi f t), f the first of the frequencies.

#include <numbers>

#include "engine/simulate/ramped.hpp"
#include "engine/simulate/references/reference_choice.hpp"
#include "engine/simulate/turns.hpp"

namespace torquescope {

namespace {

class Sine : public Reference {
 public:
  explicit Sine(double frequency_hz) : frequency_hz_(frequency_hz) {}

  ReferencePoint at(double time_s) const override {
    double const omega = 2.0 * std::numbers::pi * frequency_hz_;
    double const sine = sine_of_turns(frequency_hz_ * time_s);
    return {sine, omega * cosine_of_turns(frequency_hz_ * time_s), -omega * omega * sine};
  }

 private:
  double frequency_hz_;
};

}  // namespace

std::unique_ptr<Reference const> make_sine(ReferenceOptions const& options, double duration_s, RandomKey const&) {
  double const frequency_hz = reference_frequencies_hz(options).front();
  return ramped_to_limits(std::make_unique<Sine>(frequency_hz), frequency_hz, duration_s, options);
}

}  // namespace torquescope
