#include "engine/fit/optim/trial_controls.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "engine/fit/optim/movement.hpp"

namespace torquescope {

namespace {

constexpr double spread = 0.1;

double cauchy(RandomStream& random, double centre) {
  double const u = RandomStream::probability(random.bits());
  return centre + spread * std::tan(std::numbers::pi * (u - 0.5));
}

}  // namespace

TrialControls draw_round(TrialControls const& centre, RandomStream& random) {
  TrialControls controls;
  controls.CR = std::clamp(centre.CR + spread * random.normal(), 0.0, 1.0);
  do controls.F = std::min(cauchy(random, centre.F), 1.0);
  while (!(controls.F > 0.0));
  return controls;
}

std::vector<TrialControls> controls_of_trials(TrialStreams const& streams, std::size_t n_members,
                                              DrawControls const& draw) {
  std::vector<TrialControls> controls(n_members);
  for (std::size_t i = 0; i < n_members; ++i) {
    RandomStream random(streams.key, streams.generation, static_cast<std::uint32_t>(i));
    controls[i] = draw(i, random);
  }
  return controls;
}

void record_step(Selected const& step, std::span<TrialControls const> controls, Bounds const& bounds,
                 Progress& progress) {
  auto const movement = movement_between(step.before, step.after, step.winners, bounds, MovementNorm::raw);
  progress.PC = movement.PC;
  progress.FC = movement.FC;
  progress.F = progress.CR = 0.0;
  for (auto const& [F, CR] : controls) {
    progress.F += F / static_cast<double>(controls.size());
    progress.CR += CR / static_cast<double>(controls.size());
  }
}

}  // namespace torquescope
