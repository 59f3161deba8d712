#include "engine/diagnose/twin_batch.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/base/parallel.hpp"

namespace torquescope {

void for_each_twin(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address, std::size_t count,
                   int threads, std::function<void(VisitedTwin const&)> const& visit) {
  TORQUESCOPE_EXPECT(twin.samples() == pipeline.samples());
  Eigen::VectorXd const time_s =
      Eigen::VectorXd::LinSpaced(twin.samples(), 0.0, static_cast<double>(twin.samples() - 1) / pipeline.rate_hz());
  std::size_t const groups = (count + twin_lanes - 1) / twin_lanes;
  std::size_t const wave = static_cast<std::size_t>(std::max(1, threads));
  std::vector<TwinGroup> simulated(std::min(wave, groups));
  for (std::size_t first = 0; first < groups; first += wave) {
    // as many groups as there are threads, then all their twins: the pipeline is the longer part and spreads evenly
    std::size_t const now = std::min(wave, groups - first);
    parallel_for(now, threads, [&](std::size_t i, int) {
      twin.simulate(address, static_cast<std::uint32_t>(first + i), simulated[i]);
    });
    std::size_t const twins = std::min(count - first * twin_lanes, now * twin_lanes);
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
