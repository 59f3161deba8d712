#include "engine/infer/replicates/noise_level.hpp"

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

double square(double x) { return x * x; }

}  // namespace

NoiseLevel noise_level(NoiseQuestion const& question, ProcessedRecord const& recording, CleanTwin const& twin,
                       RecordPipeline const& pipeline, TwinAddress const& address, std::size_t twins,
                       TwinWorkers const& workers) {
  TORQUESCOPE_EXPECT(twins >= 8);
  auto const of_twins = [&](double variance) {
    TwinLoop loop = twin.loop();
    question.put(loop, std::sqrt(variance), 0.0);
    CleanTwin const noisy(twin.joint(), loop, twin.track(), twin.step_s());
    Eigen::VectorXd value = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(twins));
    TwinStatistic result;
    result.ran_away = gather_twins(
        noisy, pipeline, address, {0, twins}, workers, {entry_each(value)}, [&](VisitedTwin const& visited) {
          value[static_cast<Eigen::Index>(visited.index)] = question.statistic(visited.record);
        });
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
  // a step that the statistic sees: the slope of a smaller one is chance, and so would be the error of the level
  constexpr double seen = 2.0, larger = 4.0;
  double tried = std::min(most, question.first_guess(std::max(wanted, none.mean + seen * spread), none.mean));
  TwinStatistic some = of_twins(tried);
  while (!some.ran_away && some.mean - none.mean < seen * spread && tried < most) {
    tried = std::min(most, larger * tried);
    some = of_twins(tried);
  }
  result.ran_away = some.ran_away;
  if (some.ran_away || some.mean <= none.mean) return result;
  double slope = (some.mean - none.mean) / tried;
  double variance = std::clamp((wanted - none.mean) / slope, 0.0, most);
  // also of a level that is not there the error is asked for: at the size of that error
  double const level = std::max(variance, none.std / slope);
  double const share = level / tried;
  double spread_there =
      std::sqrt(none.std * none.std + share * share * std::max(0.0, square(some.std) - square(none.std)));
  // nothing, or more than may be: a look at the level itself says the same
  if (variance > 0.0 && variance < most) {
    TwinStatistic const there = of_twins(variance);
    result.ran_away = there.ran_away;
    if (there.ran_away) return result;
    if (there.mean - none.mean > spread) {
      slope = (there.mean - none.mean) / variance;
      spread_there = there.std;
      variance = std::clamp((wanted - none.mean) / slope, 0.0, most);
    }
  }
  // of the recording's own statistic and of the twins' mean; that it is not more than is plausible is no estimate
  if (variance < most) result.variance_error = spread_there * std::sqrt(1.0 + 2.0 / static_cast<double>(twins)) / slope;
  result.std = std::sqrt(variance);
  return result;
}

}  // namespace torquescope
