// A sum of sines with random phases: periodic with 1 / base_hz once the ramp is over.
//
// Equation   p(t) = sum_k sin(2 pi (f_k t + phase_k)) / f_k, phase_k uniform in [0, 1)
// Spectrum   1 / f_k in position is flat in velocity: no frequency dominates the friction columns
// Source     Schroeder 1970 for the crest factor of phases; random ones, because recordings must differ by seed

#include <algorithm>
#include <array>
#include <numbers>
#include <span>
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
    for (std::size_t first = 0; first < lines_.size(); first += side_by_side)
      add(std::span(lines_).subspan(first, std::min(side_by_side, lines_.size() - first)), time_s, sum);
    return sum;
  }

 private:
  static constexpr std::size_t side_by_side = 32;

  static void add(std::span<Line const> lines, double time_s, ReferencePoint& sum) {
    // sines, then cosines
    std::array<double, 2 * side_by_side> turns, values;
    for (std::size_t k = 0; k < lines.size(); ++k)
      turns[k] = turns[lines.size() + k] = lines[k].frequency_hz * time_s + lines[k].phase_turns;
    auto const angles = std::span(turns).first(2 * lines.size());
    quarter_ahead(angles.last(lines.size()));
    sines_of_turns(angles, std::span(values).first(angles.size()));

    for (std::size_t k = 0; k < lines.size(); ++k) {
      double const omega = 2.0 * std::numbers::pi * lines[k].frequency_hz;
      double const sine = values[k];
      sum.q += sine / omega;
      sum.dq += values[lines.size() + k];
      sum.ddq -= omega * sine;
    }
  }

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
