#include "engine/diagnose/noise_level.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

struct TwinStatistic {
  double mean = 0.0, std = 0.0;
  bool ran_away = false;
};

}  // namespace

NoiseLevel noise_level(NoiseQuestion const& question, ProcessedRecord const& recording, CleanTwin const& twin,
                       RecordPipeline const& pipeline, TwinAddress const& address, std::size_t twins, int threads) {
  TORQUESCOPE_EXPECT(twins >= 8);
  constexpr int rounds = 2;  // the statistic grows nearly linearly: the second is about the level
  auto const of_twins = [&](double variance) {
    TwinLoop loop = twin.loop();
    question.put(loop, std::sqrt(variance), 0.0);
    CleanTwin const noisy(twin.joint(), loop, twin.track(), twin.step_s());
    Eigen::VectorXd value = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(twins));
    std::vector<char> ran_away(twins, 0);
    for_each_twin(noisy, pipeline, address, twins, threads, [&](VisitedTwin const& visited) {
      ran_away[visited.index] = visited.ran_away;
      if (!visited.ran_away) value[static_cast<Eigen::Index>(visited.index)] = question.statistic(visited.record);
    });
    TwinStatistic result;
    result.ran_away = std::any_of(ran_away.begin(), ran_away.end(), [](char one) { return one != 0; });
    result.mean = value.mean();
    result.std = std::sqrt((value.array() - result.mean).square().sum() / static_cast<double>(twins - 1));
    return result;
  };

  double const wanted = question.statistic(recording);
  TwinStatistic const none = of_twins(0.0);
  NoiseLevel result;
  result.ran_away = none.ran_away;
  if (none.ran_away || none.mean <= 0.0) return result;
  result.ratio = wanted / none.mean;
  double const spread = none.std * std::sqrt(1.0 + 1.0 / static_cast<double>(twins));
  result.z = (wanted - none.mean) / std::max(spread, 1e-12 * none.mean);
  if (result.z <= question.least_z) return result;

  double const most = question.most_std * question.most_std;
  // also what is not there is tried, at the size of its own error: that error is asked for
  double variance = std::min(most, question.first_guess(std::max(wanted, none.mean + spread), none.mean));
  for (int round = 0; round < rounds; ++round) {
    TwinStatistic const some = of_twins(variance);
    result.ran_away = some.ran_away;
    if (some.ran_away || some.mean <= none.mean) return result;
    double const slope = (some.mean - none.mean) / variance;
    // of the recording's own statistic and of the twins' mean
    result.variance_error = some.std * std::sqrt(1.0 + 2.0 / static_cast<double>(twins)) / slope;
    double const next = std::clamp((wanted - none.mean) / slope, 0.0, most);
    // nothing, or more than may be: a second look says the same
    bool const is_at_its_end = next == 0.0 || next == most;
    variance = next;
    if (is_at_its_end) break;
  }
  result.std = std::sqrt(variance);
  return result;
}

}  // namespace torquescope
