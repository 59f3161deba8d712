#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <utility>

#include "engine/app/commands/command.hpp"
#include "engine/app/commands/notes.hpp"
#include "engine/app/commands/results.hpp"
#include "engine/app/result/finished_result.hpp"
#include "engine/app/session_progress.hpp"
#include "engine/app/terminal/interrupt.hpp"
#include "engine/base/error.hpp"
#include "engine/base/heap.hpp"

namespace torquescope {

namespace {

struct MergeArguments {
  std::string job;
  std::vector<std::string> folders{};
  std::string out{};
  int threads = 0;  // 0: not given
  bool partial = false, allow_mixed = false, allow_full_disk = false;
};

ExitCode merge_job(MergeArguments const& arguments, Session const& session) {
  prepare_heap();
  install_stop_signals(session.options().quiet ? StopNotice::silent : StopNotice::spoken);
  Experiment experiment = Experiment::load(arguments.job);
  std::filesystem::path const output =
      arguments.out.empty() ? experiment.output_file() : std::filesystem::path(arguments.out);
  if (already_complete(output, experiment.inputs_sha256(), ResultKind::runs)) {
    session.note(session.topic_line("done", "already complete: nothing is merged again"));
    ExitCode const code = end_with_results(session, read_summary(output), "kept", output);
    tidy_up(session, output, experiment.inputs_sha256());
    return code;
  }
  IdentifyOptions options;
  options.threads = choose_threads(arguments.threads);
  options.output = output;
  options.tell = [&session](std::string const& topic, std::string const& text) {
    session.note(session.topic_line(topic, text));
  };
  options.allow_mixed = arguments.allow_mixed;
  options.allow_full_disk = arguments.allow_full_disk;
  for (auto const& folder : arguments.folders) {
    validate(std::filesystem::is_directory(folder), [&] {
      return Problem{.code = ExitCode::no_input,
                     .what = folder + " is no folder",
                     .help = "name a folder of segments: they end in .h5.parts"};
    });
    options.more_segments.emplace_back(folder);
  }
  IdentifyReport report;
  {
    SessionProgress print_progress(session);
    report = merge(std::move(experiment), options, arguments.partial ? Completeness::partial : Completeness::whole,
                   [&print_progress](ProgressUpdate const& update) { print_progress(update); });
  }
  return end_with_results(session, summary_of(*report.result), "wrote", output);
}

}  // namespace

void add_merge(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<MergeArguments>();
  CLI::App* command = app.add_subcommand(
      "merge", "Makes the result of a job out of the segments of its shards: the file one machine would have made.");
  command->footer(
      "  torquescope merge lab.toml\n"
      "  torquescope merge lab.toml node1/lab.h5.parts node2/lab.h5.parts\n"
      "  torquescope merge lab.toml --partial --out so_far.h5\n");
  command->add_option("JOB.toml", arguments->job, "the job file that the shards ran")->required();
  command->add_option("R.h5.parts", arguments->folders, "more folders of segments [the one beside the result]");
  add_result_option(*command, arguments->out);
  add_json_option(*command, chosen);
  command->add_flag("--partial", arguments->partial, "merge what there is; missing runs are NaN, segments stay")
      ->group("results");
  add_threads_option(*command, arguments->threads);
  add_mixed_option(*command, arguments->allow_mixed);
  add_full_disk_option(*command, arguments->allow_full_disk);
  add_progress_option(*command, chosen);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return merge_job(*arguments, session); };
  });
}

}  // namespace torquescope
