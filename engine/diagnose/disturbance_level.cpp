#include "engine/diagnose/disturbance_level.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/diagnose/twin_batch.hpp"

namespace torquescope {
namespace {

struct Energies {
  double mean = 0.0, std = 0.0;
  bool ran_away = false;
};

Energies twin_energies(CleanTwin const& twin, double disturbance_std, RecordPipeline const& pipeline, double step_s,
                       TwinAddress const& address, std::size_t twins, int threads) {
  TwinLoop loop = twin.loop();
  loop.disturbance_std = disturbance_std;
  loop.disturbance_variance_error = 0.0;
  CleanTwin const disturbed(twin.joint(), loop, twin.track(), step_s);
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(twins));
  std::vector<char> ran_away(twins, 0);
  for_each_twin(disturbed, pipeline, address, twins, threads, [&](VisitedTwin const& visited) {
    ran_away[visited.index] = visited.ran_away;
    if (!visited.ran_away) energy[static_cast<Eigen::Index>(visited.index)] = fast_energy(visited.record);
  });
  Energies result;
  result.ran_away = std::any_of(ran_away.begin(), ran_away.end(), [](char one) { return one != 0; });
  result.mean = energy.mean();
  result.std = std::sqrt((energy.array() - result.mean).square().sum() / static_cast<double>(twins - 1));
  return result;
}

}  // namespace

double fast_energy(ProcessedRecord const& record) {
  constexpr std::size_t block = 8;  // rows: longer than the filter's memory, shorter than the time between reversals
  std::vector<double> energies;
  double sum = 0.0;
  std::size_t count = 0;
  auto const& rows = record.kept_rows;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    if (rows[i + 1] - rows[i - 1] != 2) {
      sum = 0.0;
      count = 0;
      continue;
    }
    auto const at = static_cast<Eigen::Index>(i);
    double const bend = record.residual[at - 1] - 2.0 * record.residual[at] + record.residual[at + 1];
    sum += bend * bend;
    if (++count < block) continue;
    energies.push_back(sum / static_cast<double>(block));
    sum = 0.0;
    count = 0;
  }
  if (energies.empty()) return 0.0;
  auto const middle = energies.begin() + static_cast<std::ptrdiff_t>(energies.size() / 2);
  std::nth_element(energies.begin(), middle, energies.end());
  return *middle;
}

DisturbanceLevel disturbance_level(ProcessedRecord const& recording, CleanTwin const& twin,
                                   RecordPipeline const& pipeline, double step_s, TwinAddress const& address,
                                   std::size_t twins, int threads) {
  TORQUESCOPE_EXPECT(twins >= 8);
  constexpr double z_some = 1.64;
  constexpr int rounds = 3;
  auto const energies = [&](double std) { return twin_energies(twin, std, pipeline, step_s, address, twins, threads); };
  double const wanted = fast_energy(recording);
  Energies const none = energies(0.0);
  DisturbanceLevel result;
  result.ran_away = none.ran_away;
  if (none.ran_away || none.mean <= 0.0) return result;
  result.energy_ratio = wanted / none.mean;
  double const spread = none.std * std::sqrt(1.0 + 1.0 / static_cast<double>(twins));
  result.z = (wanted - none.mean) / std::max(spread, 1e-12 * none.mean);
  if (result.z < z_some) return result;

  // as if all of the twins' energy came from their torque noise, then by secant from there
  double const scale = twin.loop().torque_noise.std > 0.0
                           ? twin.loop().torque_noise.std
                           : std::sqrt(recording.energy() / static_cast<double>(recording.residual.size()));
  double variance = (result.energy_ratio - 1.0) * scale * scale;
  for (int round = 0; round < rounds; ++round) {
    Energies const some = energies(std::sqrt(variance));
    result.ran_away = some.ran_away;
    if (some.ran_away || some.mean <= none.mean) return result;
    double const slope = (some.mean - none.mean) / variance;
    variance = (wanted - none.mean) / slope;
    // of the recording's own energy and of the twins' mean
    result.variance_error = some.std * std::sqrt(1.0 + 2.0 / static_cast<double>(twins)) / slope;
  }
  result.std = std::sqrt(variance);
  return result;
}

}  // namespace torquescope
