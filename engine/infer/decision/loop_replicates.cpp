#include "engine/infer/decision/loop_replicates.hpp"

#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/infer/decision/row_noise.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
constexpr std::uint32_t steps_before = 4096;  // of the same seed, taken by the scan

// per track, with the encoder in the loop
std::vector<std::vector<RolloutTrial>> drawn_trials(FitUnknowns const& unknowns, FitPoint const& at,
                                                    LoopReplicates const& how) {
  std::vector<std::vector<RolloutTrial>> trials;
  auto const n_tracks = static_cast<std::uint32_t>(unknowns.tracks().size());
  for (std::uint32_t t = 0; t < n_tracks; ++t) {
    double const step = unknowns.tracks()[t].encoder_step;
    trials.push_back(unknowns.trials_on(t, std::vector<FitPoint>(how.count, at)));
    for (std::uint32_t k = 0; k < how.count; ++k) {
      RandomStream random({how.seed, k * n_tracks + t, RandomDomain::simulation}, steps_before + how.step, 0);
      trials.back()[k].encoder_step = step;
      trials.back()[k].encoder_phase = step * (random.uniform() - 0.5);
    }
  }
  return trials;
}

// adds what the recording leaves beyond replicates without noise
void add_noise(Eigen::MatrixXd& replicates, Eigen::VectorXd const& residual, LoopReplicates const& how,
               std::uint32_t part, std::uint32_t parts) {
  std::vector<OctavePowers> without;
  for (Index k = 0; k < replicates.cols(); ++k) without.push_back(octave_powers(replicates.col(k)));
  OctavePowers const powers = less(octave_powers(residual), mean_of(without));
  parallel_for(static_cast<std::size_t>(replicates.cols()), how.threads, [&](std::size_t k, int) {
    auto const replicate = static_cast<std::uint32_t>(k) * parts + part;
    replicates.col(static_cast<Index>(k)) +=
        drawn_noise(powers, replicates.rows(), {how.seed, steps_before + how.step, replicate});
  });
}

}  // namespace

ChannelRows loop_replicates(FitUnknowns const& unknowns, FitPoint const& at, LoopReplicates const& how) {
  auto const model = unknowns.residuals_at({at}, 1);
  auto made = residuals_of(unknowns.task(), drawn_trials(unknowns, at, how), how.threads);
  std::vector<Index> kept;
  for (Index k = 0; k < static_cast<Index>(how.count); ++k) {
    bool is_finite = true;
    for (auto const& track : made)
      for (auto const& samples : track.samples)
        is_finite = is_finite && (samples.size() == 0 || samples.col(k).allFinite());
    if (is_finite) kept.push_back(k);
  }
  ChannelRows all;
  auto const parts = static_cast<std::uint32_t>(made.size() * n_channels);
  for (std::size_t channel = 0; channel < n_channels; ++channel) {
    Index rows = 0;
    for (auto const& track : made) rows += track.samples[channel].rows();
    if (rows == 0 || kept.empty()) continue;
    all[channel].resize(rows, static_cast<Index>(kept.size()));
    Index row = 0;
    for (std::size_t t = 0; t < made.size(); ++t) {
      auto const& samples = made[t].samples[channel];
      if (samples.size() == 0) continue;
      Eigen::VectorXd const own = model[t].samples[channel].col(0);
      Eigen::MatrixXd part(samples.rows(), static_cast<Index>(kept.size()));
      for (std::size_t k = 0; k < kept.size(); ++k) part.col(static_cast<Index>(k)) = own - samples.col(kept[k]);
      add_noise(part, own, how, static_cast<std::uint32_t>(t * n_channels + channel), parts);
      all[channel].middleRows(row, samples.rows()) = part;
      row += samples.rows();
    }
  }
  return all;
}

}  // namespace torquescope
