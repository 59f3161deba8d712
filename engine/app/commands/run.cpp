#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <utility>

#include "engine/app/commands/command.hpp"
#include "engine/app/commands/notes.hpp"
#include "engine/app/result/finished_result.hpp"
#include "engine/app/result/paper_tables.hpp"
#include "engine/app/result/result_json.hpp"
#include "engine/app/result/result_tables.hpp"
#include "engine/app/session_progress.hpp"
#include "engine/app/terminal/interrupt.hpp"
#include "engine/run/workflows.hpp"

namespace torquescope {

namespace {

struct RunArguments {
  std::string job;
  std::string out{};
  int threads = 0;  // 0: not given
};

void print_results(Session const& session, ResultSummary const& summary) {
  session.note("\n");
  session.result(result_table(summary, session.result_ink()));
  session.result(paper_tables(summary, session.result_ink()));
  session.document(result_json(summary));
}

ExitCode run_job(RunArguments const& arguments, Session const& session) {
  Experiment experiment = Experiment::load(arguments.job);
  std::filesystem::path const output =
      arguments.out.empty() ? experiment.output_file() : std::filesystem::path(arguments.out);

  if (already_complete(output, experiment.inputs_sha256(), ResultKind::runs)) {
    session.note(session.topic_line("job", experiment.job_line()));
    session.note(session.topic_line("done", "already complete: nothing runs again"));
    ResultSummary const summary = read_summary(output);
    print_results(session, summary);
    note_whereabouts(session, "kept", output);
    return ExitCode::ok;
  }

  IdentifyOptions options;
  options.threads = choose_threads(arguments.threads);
  options.output = output;
  options.stop_requested = stop_requested;
  note_start(session, experiment.job_line(), experiment, options.threads);
  for (auto const& line : experiment.fitness_lines()) session.note(session.topic_line("fitness", line));
  install_stop_signals(session.options().quiet ? StopNotice::silent : StopNotice::spoken);
  {
    ProgressPrinter print_progress(progress_settings(session));
    identify(std::move(experiment), options,
             [&print_progress](ProgressUpdate const& update) { print_progress(update); });
  }
  ResultSummary const summary = read_summary(output);
  print_results(session, summary);
  note_whereabouts(session, "wrote", output);
  return ExitCode::ok;
}

}  // namespace

void add_run(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<RunArguments>();
  CLI::App* command =
      app.add_subcommand("run", "Identifies the parameters of a job's model; the same job is not run twice.");
  command->footer(
      "  torquescope run jobs/crs_a465_joint.toml\n"
      "  torquescope run lab.toml --threads 4 --out lab_4.h5\n"
      "  torquescope run lab.toml --quiet --json - | jq .estimators\n");
  command->add_option("JOB.toml", arguments->job, "job file, TOML (torquescope list sections)")->required();
  add_result_option(*command, arguments->out);
  add_json_option(*command, chosen);
  add_threads_option(*command, arguments->threads);
  add_progress_option(*command, chosen);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return run_job(*arguments, session); };
  });
}

}  // namespace torquescope
