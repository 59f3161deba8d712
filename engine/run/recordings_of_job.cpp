#include "engine/run/recordings_of_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/data/change_of_rate.hpp"
#include "engine/data/split_recording.hpp"

namespace torquescope {

RawTable table_of_job(Job const& job, std::string const& name, Section const& section, RecordedTables const& tables) {
  auto const in_memory = tables.find(name);
  return in_memory != tables.end() ? in_memory->second : read_table(job.resolve(name), section);
}

double rate_of_job(std::vector<Recording> const& train, std::vector<Recording> const& validate) {
  constexpr double about_the_same = 0.1;
  double const first = train.front().rate_hz;
  double lowest = first, highest = first;
  for (auto const* recordings : {&train, &validate})
    for (auto const& recording : *recordings) {
      lowest = std::min(lowest, recording.rate_hz);
      highest = std::max(highest, recording.rate_hz);
    }
  return highest <= (1.0 + about_the_same) * lowest ? first : lowest;
}

void bring_to_rate(std::vector<Recording>& recordings, double rate_hz) {
  for (auto& recording : recordings) {
    double const own = recording.rate_hz;
    if (std::fabs(own - rate_hz) <= 1e-6 * rate_hz) continue;
    recording = at_rate(std::move(recording), rate_hz);
    recording.warnings.push_back(
        {"rate", fmt::format("sampled at {:.6g} Hz, resampled to the {:.6g} Hz of the job", own, rate_hz)});
  }
}

void split_off_unseen(std::vector<Recording>& train, std::vector<Recording>& unseen, double share) {
  if (share >= 1.0) return;
  for (auto& recording : train) {
    auto [head, tail] = split_recording(recording, share);
    recording = std::move(head);
    unseen.push_back(std::move(tail));
  }
}

}  // namespace torquescope
