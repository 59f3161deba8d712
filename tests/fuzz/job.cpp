// Job texts: engine/experiment/job/, and what tables of options make of their sections.
#include <string>

#include "engine/data/recording_reader.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/experiment/job/job_options.hpp"
#include "tests/fuzz/hostile_reader.hpp"

namespace torquescope {
namespace {

template <class Options>
void apply(Job const& job, std::vector<Problem>& problems) {
  Options options;
  for (auto const* section : job.all(Options::table().section())) Options::table().apply(*section, options, problems);
}

void read(std::string_view bytes) {
  Job const job = parse_job(std::string(bytes), "job.toml");
  std::vector<Problem> problems;
  apply<ExperimentOptions>(job, problems);
  apply<OutputOptions>(job, problems);
  apply<RecordingOptions>(job, problems);
}

}  // namespace

HostileReader const hostile_job{.read = read};

}  // namespace torquescope
