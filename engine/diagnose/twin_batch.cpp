#include "engine/diagnose/twin_batch.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/base/parallel.hpp"

namespace torquescope {

void for_each_twin(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                   TwinRange const& range, int threads, std::function<void(VisitedTwin const&)> const& visit) {
  TORQUESCOPE_EXPECT(twin.samples() == pipeline.samples());
  if (range.to <= range.from) return;
  TORQUESCOPE_EXPECT(range.from % twin_lanes == 0);
  Eigen::VectorXd const time_s =
      Eigen::VectorXd::LinSpaced(twin.samples(), 0.0, static_cast<double>(twin.samples() - 1) / pipeline.rate_hz());
  std::size_t const first_group = range.from / twin_lanes, groups = (range.to + twin_lanes - 1) / twin_lanes;
  std::size_t const wave = static_cast<std::size_t>(std::max(1, threads));
  std::vector<TwinGroup> simulated(std::min(wave, groups - first_group));
  for (std::size_t first = first_group; first < groups; first += wave) {
    // as many groups as there are threads, then all their twins: the pipeline is the longer part and spreads evenly
    std::size_t const now = std::min(wave, groups - first);
    parallel_for(now, threads, [&](std::size_t i, int) {
      twin.simulate(address, static_cast<std::uint32_t>(first + i), simulated[i]);
    });
    std::size_t const twins = std::min(range.to - first * twin_lanes, now * twin_lanes);
    parallel_for(twins, threads, [&](std::size_t i, int thread) {
      TwinGroup const& group = simulated[i / twin_lanes];
      std::size_t const lane = i % twin_lanes;
      bool const ran_away = group.ran_away[lane];
      ProcessedRecord record;
      if (!ran_away) {
        Recording recording;
        recording.name = "twin";
        recording.rate_hz = pipeline.rate_hz();
        recording.time_s = time_s;
        recording.position = group.position[lane];
        recording.torque = group.torque[lane];
        record = pipeline.process(recording);
      }
      visit({first * twin_lanes + i, thread, ran_away, record});
    });
  }
}

}  // namespace torquescope
