#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <utility>

#include "engine/app/commands/command.hpp"
#include "engine/app/commands/notes.hpp"
#include "engine/app/commands/results.hpp"
#include "engine/app/commands/shard_choice.hpp"
#include "engine/app/result/finished_result.hpp"
#include "engine/app/session_progress.hpp"
#include "engine/app/terminal/environment.hpp"
#include "engine/app/terminal/interrupt.hpp"
#include "engine/base/heap.hpp"
#include "engine/experiment/experiment_parts.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

struct RunArguments {
  std::string job;
  std::string out{};
  std::string continued{};
  int threads = 0;  // 0: not given
  std::string shard{};
  double time_budget_s = 0.0;  // 0: none
  double segment_seconds = 20.0;
  bool allow_mixed = false, allow_full_disk = false;
};

std::string words_of_share(ShardChoice const& shard, Experiment const& experiment) {
  auto const runs = static_cast<std::size_t>(experiment.parts().experiment.runs);
  std::size_t const first = shard.first(runs), end = shard.end(runs);
  return first == end ? fmt::format("none of {} runs", runs) : fmt::format("runs {} to {} of {}", first, end - 1, runs);
}

// a share of the runs, into segments
ExitCode run_share(Experiment experiment, IdentifyOptions const& options, std::string const& job,
                   Session const& session) {
  ShardReport report;
  {
    SessionProgress print_progress(session);
    report = run_shard(std::move(experiment), options,
                       [&print_progress](ProgressUpdate const& update) { print_progress(update); });
  }
  std::string const folder = segment_folder_of(options.output).string();
  session.note(session.topic_line(
      "done", fmt::format("shard {}/{}: {} runs are safe in {} ({} were done before)", options.shard.index,
                          options.shard.count, report.runs, folder, report.runs_before)));
  session.note(session.topic_line("next", fmt::format("when all {} shards are done: torquescope merge {} --out {}",
                                                      options.shard.count, job, options.output.string())));
  return ExitCode::ok;
}

// a result that goes on is replaced by what it becomes
std::filesystem::path output_of(RunArguments const& arguments, Experiment const& experiment) {
  if (!arguments.out.empty()) return arguments.out;
  return arguments.continued.empty() ? experiment.output_file() : std::filesystem::path(arguments.continued);
}

ExitCode run_job(RunArguments const& arguments, Session const& session) {
  prepare_heap();
  ShardChoice const shard = choose_shard(arguments.shard, environment);
  install_stop_signals(session.options().quiet ? StopNotice::silent : StopNotice::spoken);
  if (arguments.time_budget_s > 0.0) stop_after(arguments.time_budget_s);
  Experiment experiment = load_with_bar(session, arguments.job, Experiment::Purpose::identify);
  give_back_holes();
  std::filesystem::path const output = output_of(arguments, experiment);

  if (already_complete(output, experiment.inputs_sha256(), ResultKind::runs, arguments.continued)) {
    session.note(session.topic_line("job", experiment.job_line()));
    session.note(session.topic_line("done", "already complete: nothing runs again"));
    ExitCode const code = end_with_results(session, read_summary(output), "kept", output);
    tidy_up(session, output, experiment.inputs_sha256());
    return code;
  }

  IdentifyOptions options;
  options.threads = choose_threads(arguments.threads);
  options.output = output;
  options.stop_requested = stop_requested;
  options.stop_words = stop_words;
  options.saving = saving_begins;
  options.tell = [&session](std::string const& topic, std::string const& text) {
    session.note(session.topic_line(topic, text));
  };
  options.shard = shard;
  options.segment_seconds = arguments.segment_seconds;
  options.allow_mixed = arguments.allow_mixed;
  options.allow_full_disk = arguments.allow_full_disk;
  options.continued = arguments.continued;
  if (progress_settings(session).style == ProgressStyle::lines)
    options.safe = [&session](std::size_t runs, std::size_t all) {
      session.note(session.topic_line("safe", fmt::format("{} of {} runs", runs, all)));
    };
  note_start(session, experiment.job_line(), experiment, options.threads);
  for (auto const& line : experiment.fitness_lines()) session.note(session.topic_line("fitness", line));
  if (shard.count > 1) {
    session.note(
        session.topic_line("shard", fmt::format("{}/{} ({}): {}; --shard 0/1 for all", shard.index, shard.count,
                                                shard.reason, words_of_share(shard, experiment))));
    return run_share(std::move(experiment), options, arguments.job, session);
  }
  IdentifyReport report;
  {
    SessionProgress print_progress(session);
    report = identify(std::move(experiment), options,
                      [&print_progress](ProgressUpdate const& update) { print_progress(update); });
  }
  return end_with_results(session, summary_of(*report.result), "wrote", output);
}

}  // namespace

void add_run(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand(
      "run", "Identifies the parameters of a job's model. Killed or stopped? The same command goes on.");
  command->footer(
      "  torquescope run jobs/crs_a465_joint.toml --threads 4 --out crs.h5\n"
      "  torquescope run lab.toml --continue lab.h5        more generations than before\n"
      "  torquescope run lab.toml --shard 0/2; torquescope run lab.toml --shard 1/2\n");
  command->add_option("JOB.toml", arguments->job, "job file, TOML (torquescope list sections)")->required();
  add_result_option(*command, arguments->out);
  command
      ->add_option("--continue", arguments->continued,
                   "a result of the same job with a smaller budget: its searches go on where they ended, and without "
                   "--out the larger result takes its place")
      ->type_name("OLD.h5")
      ->group("results");
  add_json_option(*command, chosen);
  add_threads_option(*command, arguments->threads);
  add_seconds_option(*command, "--time-budget", arguments->time_budget_s,
                     "stop and save in time to be gone after S seconds (exit 75)");
  add_seconds_option(*command, "--save-every", arguments->segment_seconds,
                     "seconds between two segments in R.h5.parts [20]");
  command
      ->add_option("--shard", arguments->shard,
                   "the share I of N of the runs, for torquescope merge [SLURM_ARRAY_TASK_ID, SLURM_PROCID, "
                   "OMPI_COMM_WORLD_RANK]")
      ->type_name("I/N")
      ->check(no_shard)
      ->group("machine");
  add_mixed_option(*command, arguments->allow_mixed);
  add_full_disk_option(*command, arguments->allow_full_disk);
  add_progress_option(*command, chosen);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return run_job(*arguments, session); };
  });
}

}  // namespace torquescope
