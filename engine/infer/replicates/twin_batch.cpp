#include "engine/infer/replicates/twin_batch.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/base/digest.hpp"
#include "engine/base/parallel.hpp"

namespace torquescope {
namespace {

// Enough to tell a batch from any other of the same diagnosis. What else its twins follow from (law, effects, weights)
// follows from the job
std::string identity_of(CleanTwin const& twin, TwinAddress const& address, TwinRange const& range,
                        std::size_t numbers) {
  auto const& joint = twin.joint();
  auto const& loop = twin.loop();
  Digest digest;
  for (std::uint64_t const whole :
       {address.seed, std::uint64_t{address.recording}, std::uint64_t{address.set}, std::uint64_t{range.from},
        std::uint64_t{range.to}, std::uint64_t{numbers}, static_cast<std::uint64_t>(twin.samples())})
    digest.bytes(&whole, sizeof whole);
  digest.numbers(std::vector{joint.lanes.inertia, joint.lanes.viscous, joint.lanes.gravity_sin, joint.lanes.gravity_cos,
                             joint.coulomb_forward, joint.coulomb_backward, joint.offset, loop.encoder_step,
                             loop.torque_noise.std, loop.slow_torque_noise.std, loop.torque_noise_variance_error,
                             loop.disturbance_std, loop.disturbance_variance_error, loop.position_noise_std,
                             loop.friction_wander, loop.friction_wander_variance_error, twin.step_s()});
  digest.numbers(std::vector{loop.sticking.least_creep, loop.sticking.most_creep, loop.sticking.most_length});
  return digest.hex();
}

// 0 or 1 whether it ran away, then what its places hold, which nobody wrote for a twin that did
void get_numbers(std::vector<TwinPlaces> const& places, bool ran_away, std::size_t twin, std::span<double> out) {
  std::size_t at = 0;
  out[at++] = ran_away ? 1.0 : 0.0;
  for (auto const& place : places)
    for (Eigen::Index k = 0; k < place.count; ++k)
      out[at++] = ran_away ? 0.0 : place.first[static_cast<Eigen::Index>(twin) * place.next_twin + k * place.next];
}

bool put_numbers(std::vector<TwinPlaces> const& places, std::size_t twin, std::span<double const> in) {
  std::size_t at = 1;
  for (auto const& place : places)
    for (Eigen::Index k = 0; k < place.count; ++k)
      place.first[static_cast<Eigen::Index>(twin) * place.next_twin + k * place.next] = in[at++];
  return in[0] != 0.0;
}

// lets go of each as it is copied: at the full rate, twice is much
Eigen::MatrixXd taken_in_columns(std::array<Eigen::VectorXd, twin_lanes>& signals) {
  Eigen::MatrixXd all(signals.front().size(), static_cast<Eigen::Index>(twin_lanes));
  for (std::size_t lane = 0; lane < twin_lanes; ++lane)
    all.col(static_cast<Eigen::Index>(lane)) = std::exchange(signals[lane], {});
  return all;
}

}  // namespace

Recording recording_of(TwinGroup const& group, std::size_t lane, double rate_hz) {
  Recording recording;
  recording.name = twins_name;
  recording.rate_hz = rate_hz;
  recording.position = group.position[lane];
  recording.torque = group.torque[lane];
  Eigen::Index const samples = recording.torque.size();
  recording.time_s = Eigen::VectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1) / rate_hz);
  return recording;
}

void for_each_twin(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                   TwinRange const& range, int threads, std::function<void(VisitedTwin const&)> const& visit) {
  TORQUESCOPE_EXPECT(twin.samples() == pipeline.samples());
  if (range.to <= range.from) return;
  TORQUESCOPE_EXPECT(range.from % twin_lanes == 0);
  std::size_t const first_group = range.from / twin_lanes, groups = (range.to + twin_lanes - 1) / twin_lanes;
  std::size_t const wave = static_cast<std::size_t>(std::max(1, threads));
  std::vector<TwinGroup> simulated(std::min(wave, groups - first_group));
  std::vector<RecordPipeline::SmoothPositions> smooth(simulated.size());  // of a group
  for (std::size_t first = first_group; first < groups; first += wave) {
    // as many groups as there are threads, then all their twins: the pipeline is the longer part and spreads evenly
    std::size_t const now = std::min(wave, groups - first);
    std::fill(smooth.begin(), smooth.end(), RecordPipeline::SmoothPositions{});
    parallel_for(now, threads, [&](std::size_t i, int) {
      twin.simulate(address, static_cast<std::uint32_t>(first + i), simulated[i]);
      smooth[i] = pipeline.smoothed(taken_in_columns(simulated[i].position));
    });
    std::size_t const twins = std::min(range.to - first * twin_lanes, now * twin_lanes);
    parallel_for(twins, threads, [&](std::size_t i, int thread) {
      TwinGroup const& group = simulated[i / twin_lanes];
      std::size_t const lane = i % twin_lanes;
      static ProcessedRecord const none;
      std::optional<ProcessedRecord> record;
      if (!group.ran_away[lane])
        record = pipeline.process_smooth(recording_of(group, lane, pipeline.rate_hz()), smooth[i / twin_lanes],
                                         static_cast<Eigen::Index>(lane));
      visit({first * twin_lanes + i, thread, !record, record ? *record : none});
    });
  }
}

bool gather_twins(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                  TwinRange const& range, TwinWorkers const& workers, std::vector<TwinPlaces> const& places,
                  std::function<void(VisitedTwin const&)> const& visit) {
  if (range.to <= range.from) return false;
  std::vector<char> ran_away(range.size(), 0);
  auto const compute = [&](TwinRange const& part) {
    for_each_twin(twin, pipeline, address, part, workers.threads, [&](VisitedTwin const& visited) {
      ran_away[visited.index - range.from] = visited.ran_away;
      if (!visited.ran_away) visit(visited);
    });
  };
  if (workers.exchange == nullptr) {
    compute(range);
  } else {
    std::size_t numbers = 1;
    for (auto const& place : places) numbers += static_cast<std::size_t>(place.count);
    workers.exchange->fill({identity_of(twin, address, range, numbers), range, twin.samples(), numbers, compute,
                            [&](std::size_t index, std::span<double> out) {
                              get_numbers(places, ran_away[index - range.from] != 0, index, out);
                            },
                            [&](std::size_t index, std::span<double const> in) {
                              ran_away[index - range.from] = put_numbers(places, index, in);
                            }});
  }
  return std::any_of(ran_away.begin(), ran_away.end(), [](char one) { return one != 0; });
}

}  // namespace torquescope
