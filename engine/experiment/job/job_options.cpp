#include "engine/experiment/job/job_options.hpp"

namespace torquescope {

OptionTable<ExperimentOptions> const& ExperimentOptions::table() {
  static OptionTable<ExperimentOptions> const options(
      "experiment", "what the experiment is called and how often chance is drawn",
      {
          {"name", &ExperimentOptions::name, "name of the experiment and of its result file; default: the job file's"},
          {"study", &ExperimentOptions::study, {"crs_a465"}, "published study whose tables stand beside ours"},
          {"seed", &ExperimentOptions::seed, "1", 0.0, 9007199254740992.0, "seed of every random number of the job"},
          {"runs", &ExperimentOptions::runs, "1", 1.0, 1e7, "independent runs of every population method"},
      });
  return options;
}

OptionTable<OutputOptions> const& OutputOptions::table() {
  static OptionTable<OutputOptions> const options(
      "output", "where the results go",
      {
          {"file", &OutputOptions::file, "result file; default: NAME.h5 in the working folder"},
          {"compression", &OutputOptions::compression, {"none", "gzip"}, "compression of the histories"},
          {"samples", &OutputOptions::samples,
           "store every sample of the recordings with its row of the regressor; without them the file and the memory "
           "are small, and there is no page"},
          {"populations", &OutputOptions::populations,
           "store every member of every generation; without them a history is what the best one was and what the "
           "method did, and a study of an arm takes megabytes instead of gigabytes"},
          {"history", &OutputOptions::history,
           "generations of each run that are stored: \"full\" (every one), \"every 10\" (0, 10, 20, ... and the last) "
           "or \"last\"; --continue needs a full history"},
      });
  return options;
}

}  // namespace torquescope
