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

class Multisine : public Reference {
 public:
  explicit Multisine(std::vector<SineLine> lines) : lines_(std::move(lines)) {}

  ReferencePoint at(double time_s) const override {
    ReferencePoint sum;
    for (std::size_t first = 0; first < lines_.size(); first += side_by_side)
      add(std::span(lines_).subspan(first, std::min(side_by_side, lines_.size() - first)), time_s, sum);
    return sum;
  }

  void at_each(std::span<double const> times_s, ReferenceColumns const& points) const override {
    for (std::size_t first = 0; first < times_s.size(); first += times_together) {
      std::size_t const count = std::min(times_together, times_s.size() - first);
      ReferenceColumns const block{points.q.subspan(first, count), points.dq.subspan(first, count),
                                   points.ddq.subspan(first, count)};
      for (auto const& column : {block.q, block.dq, block.ddq}) std::fill(column.begin(), column.end(), 0.0);
      for (SineLine const& line : lines_)
        add_sine_line(line, times_s.subspan(first, count), block.q, block.dq, block.ddq);
    }
  }

 private:
  static constexpr std::size_t side_by_side = 32;
  static constexpr std::size_t times_together = 256;

  static void add(std::span<SineLine const> lines, double time_s, ReferencePoint& sum) {
    std::array<double, side_by_side> turns, sines, cosines;
    for (std::size_t k = 0; k < lines.size(); ++k) turns[k] = lines[k].frequency_hz * time_s + lines[k].phase_turns;
    sines_cosines_of_turns(std::span(turns).first(lines.size()), std::span(sines).first(lines.size()),
                           std::span(cosines).first(lines.size()));
    for (std::size_t k = 0; k < lines.size(); ++k) {
      sum.q += sines[k] * lines[k].inverse_omega;
      sum.dq += cosines[k];
      sum.ddq -= lines[k].omega * sines[k];
    }
  }

  std::vector<SineLine> lines_;
};

}  // namespace

std::unique_ptr<Reference const> make_multisine(ReferenceOptions const& options, double duration_s,
                                                RandomKey const& key) {
  std::vector<double> const frequencies = reference_frequencies_hz(options);
  std::vector<SineLine> lines;
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    double const omega = 2.0 * std::numbers::pi * frequencies[k];
    lines.push_back({frequencies[k], addressed_uniform(key, NoiseStream::reference_phase, k), omega, 1.0 / omega});
  }
  double const highest_hz = *std::max_element(frequencies.begin(), frequencies.end());
  return ramped_to_limits(std::make_unique<Multisine>(std::move(lines)), highest_hz, duration_s, options);
}

}  // namespace torquescope
