#include "engine/infer/replicates/disturbance_level.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/base/median.hpp"

namespace torquescope {

std::size_t fast_lag(RecordPipeline const& pipeline) {
  constexpr double periods_apart = 0.4;
  double const apart =
      pipeline.cutoff_hz() > 0.0 ? periods_apart * pipeline.kept_rate_hz() / pipeline.cutoff_hz() : 1.0;
  return static_cast<std::size_t>(std::max(1.0, std::round(apart)));
}

double fast_energy(ProcessedRecord const& record, RecordPipeline const& pipeline) {
  std::size_t const lag = fast_lag(pipeline);
  // longer than the filter's memory, shorter than the time between reversals
  std::size_t const block = 8 * lag;
  std::vector<double> energies;
  double sum = 0.0;
  std::size_t count = 0;
  auto const& rows = record.kept_rows;
  Eigen::VectorXd residual = record.residual_itself();
  pipeline.take_shares(residual, rows);
  for (std::size_t i = lag; i + lag < rows.size(); ++i) {
    if (rows[i + lag] - rows[i - lag] != static_cast<Eigen::Index>(2 * lag)) {
      sum = 0.0;
      count = 0;
      continue;
    }
    auto const at = static_cast<Eigen::Index>(i);
    auto const step = static_cast<Eigen::Index>(lag);
    double const bend = residual[at - step] - 2.0 * residual[at] + residual[at + step];
    sum += bend * bend;
    if (++count < block) continue;
    energies.push_back(sum / static_cast<double>(block));
    sum = 0.0;
    count = 0;
  }
  return energies.empty() ? 0.0 : upper_median(std::move(energies));
}

NoiseLevel disturbance_level(ProcessedRecord const& recording, CleanTwin const& twin, RecordPipeline const& pipeline,
                             TwinAddress const& address, std::size_t twins, TwinWorkers const& workers) {
  // first as if all of the twins' energy came from their torque noise
  double const scale =
      twin.loop().torque_noise.std > 0.0
          ? twin.loop().torque_noise.std
          : std::sqrt(recording.residual_itself().squaredNorm() / static_cast<double>(recording.residual.size()));
  NoiseQuestion const question{[&](ProcessedRecord const& record) { return fast_energy(record, pipeline); },
                               [](TwinLoop& loop, double std, double variance_error) {
                                 loop.disturbance_std = std;
                                 loop.disturbance_variance_error = variance_error;
                               },
                               [&](double wanted, double none) { return (wanted / none - 1.0) * scale * scale; }};
  return noise_level(question, recording, twin, pipeline, address, twins, workers);
}

}  // namespace torquescope
