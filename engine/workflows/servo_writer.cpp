#include "engine/base/error.hpp"
#include "engine/experiment/runs/provenance_writer.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/workflows/replay_writer.hpp"
#include "engine/workflows/servo_words.hpp"
#include "engine/workflows/servo_workflow.hpp"

namespace torquescope {

void refuse_other_result(std::filesystem::path const& output) {
  std::error_code ignored;
  if (!std::filesystem::exists(output, ignored)) return;
  ResultReader const there(output);
  validate(there.exists("/servo"), [&] {
    Problem problem{ExitCode::exists, output.string() + " is no earlier diagnosis of a set of recordings"};
    problem.help = "--out another name, or delete it";
    return problem;
  });
}

void write_servo_file(ServoJob const& job, ServoReport const& report, ServoRequest const& request,
                      std::array<std::string, 2> const& printed, Beginning const& beginning) {
  refuse_other_result(request.output);
  ResultWriter writer(request.output, {.gzip = job.output.compression == "gzip", .inputs_sha256 = job.inputs_sha256()});
  writer.texts("/job/text", std::vector<std::string>{job.job.text}, {"1", "job file, verbatim"});
  writer.attribute("/job", "name", job.experiment.name);
  writer.attribute("/job", "study", job.experiment.study);
  writer.attribute("/job", "seed", job.experiment.seed);
  writer.attribute("/job", "runs", std::int64_t{0});
  writer.attribute("/job", "sha256", job.job.sha256);
  writer.attribute("/servo", "verdict", word(report.verdict));
  writer.attribute("/servo", "headline", headline(report));
  writer.texts("/servo/json", std::vector<std::string>{servo_json(report)}, {"1", "the whole diagnosis, JSON"});
  writer.texts("/servo/printed", printed, {"1", "the verdict and the tables, as printed"});
  if (!report.replay.recordings.empty()) write_replay(writer, report.replay);
  finish_result(writer, request.output, request.threads, beginning);
}

}  // namespace torquescope
