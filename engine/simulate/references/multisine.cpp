// A sum of sines with random phases: periodic with 1 / base_hz once the ramp is over.
//
// Equation   p(t) = sum_k sin(2 pi (f_k t + phase_k)) / f_k, phase_k uniform in [0, 1)
// Spectrum   1 / f_k in position is flat in velocity: no frequency dominates the friction columns
// Source     Schroeder 1970 for the crest factor of phases; random ones, because recordings must differ by seed

#include <algorithm>
#include <numbers>
#include <utility>

#include "engine/simulate/noise.hpp"
#include "engine/simulate/ramped.hpp"
#include "engine/simulate/references/reference_choice.hpp"
#include "engine/simulate/turns.hpp"

namespace torquescope {

namespace {

struct Line {
  double frequency_hz, phase_turns;
};

class Multisine : public Reference {
 public:
  explicit Multisine(std::vector<Line> lines) : lines_(std::move(lines)) {}

  ReferencePoint at(double time_s) const override {
    ReferencePoint sum;
    for (Line const& line : lines_) {
      double const turns = line.frequency_hz * time_s + line.phase_turns;
      double const omega = 2.0 * std::numbers::pi * line.frequency_hz;
      double const sine = sine_of_turns(turns);
      sum.q += sine / omega;
      sum.dq += cosine_of_turns(turns);
      sum.ddq -= omega * sine;
    }
    return sum;
  }

 private:
  std::vector<Line> lines_;
};

}  // namespace

std::unique_ptr<Reference const> make_multisine(ReferenceOptions const& options, double duration_s,
                                                RandomKey const& key) {
  std::vector<double> const frequencies = reference_frequencies_hz(options);
  std::vector<Line> lines;
  for (std::size_t k = 0; k < frequencies.size(); ++k)
    lines.push_back({frequencies[k], addressed_uniform(key, NoiseStream::reference_phase, k)});
  double const highest_hz = *std::max_element(frequencies.begin(), frequencies.end());
  return ramped_to_limits(std::make_unique<Multisine>(std::move(lines)), highest_hz, duration_s, options);
}

}  // namespace torquescope
