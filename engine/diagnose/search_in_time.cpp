#include "engine/diagnose/search_in_time.hpp"

#include <utility>

#include "engine/infer/search/channel_timing.hpp"

namespace torquescope {

std::unique_ptr<StepwiseSearch const> search_in_time(StageSetting& setting, Recording& recording,
                                                     OwnedRecordings& others, SearchRules const& rules, double& late_s,
                                                     StageSink const& progress) {
  constexpr int most_times = 2;
  auto const search = [&] {
    return std::make_unique<StepwiseSearch const>(
        search_stepwise(setting, rules.options, rules.levels, others.others(), progress));
  };
  auto found = search();
  auto const as_read = std::make_shared<RecordedLoop const>(found->end().selection.baseline->twin->loop);
  for (int i = 0; i < most_times; ++i) {
    auto const more_s = delay_within_a_sample(found->end().selection, false, late_s, recording.rate_hz);
    if (!more_s) break;
    late_s += *more_s;
    recording = with_torque_earlier(std::move(recording), *more_s);
    for (auto& one : others.all) one = with_torque_earlier(std::move(one), *more_s);
    if (loses_the_law(*as_read, recording)) setting.loop = as_read;
    found = search();
  }
  return found;
}

}  // namespace torquescope
