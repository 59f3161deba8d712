#include <utility>

#include "engine/data/health/make_recording.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/recording_set.hpp"
#include "engine/experiment/recordings_of_job.hpp"
#include "engine/experiment/sample_range.hpp"

namespace torquescope {

std::vector<SetRecording> read_recordings(Job const& job, std::vector<SetEntry> const& entries) {
  std::vector<Problem> problems;
  auto const options = read_options<RecordingOptions>(job, problems);
  if (!problems.empty()) throw Error(std::move(problems));
  if (entries.empty()) return {};
  Section const section = section_or_empty(job, "recording");

  std::vector<Recording> train, validate;
  for (auto const& entry : entries) {
    RawTable const table = read_table(entry.path, section);
    refuse_huge_samples(table, options);
    auto recording = make_recording(table, options, section, OtherJoints::ignored, TorqueColumn::optional);
    recording.name = entry.name;
    (entry.is_validation ? validate : train).push_back(std::move(recording));
  }
  require_inputs(job, options, train, validate);
  double const rate_hz = train.empty() ? rate_of_job(validate, {}) : rate_of_job(train, validate);
  bring_to_rate(train, rate_hz);
  bring_to_rate(validate, rate_hz);

  // in the order of the entries again
  std::vector<SetRecording> recordings;
  auto next_train = train.begin(), next_validate = validate.begin();
  for (auto const& entry : entries)
    recordings.push_back({entry, std::move(entry.is_validation ? *next_validate++ : *next_train++)});
  return recordings;
}

}  // namespace torquescope
