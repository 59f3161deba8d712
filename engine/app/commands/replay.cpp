#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>

#include "engine/app/commands/command.hpp"
#include "engine/app/commands/notes.hpp"
#include "engine/app/result/replay_text.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/store/temp_file.hpp"
#include "engine/workflows/replay_workflow.hpp"

namespace torquescope {

namespace {

struct ReplayArguments {
  std::string source;
  std::vector<std::string> recordings{};
  std::string job{}, out{}, csv{}, estimator{};
  int threads = 0;
};

ExitCode replay_source(ReplayArguments const& arguments, Session const& session) {
  ReplayRequest request;
  request.source = arguments.source;
  request.recordings = arguments.recordings;
  request.job = arguments.job;
  request.estimator = arguments.estimator;
  request.threads = choose_threads(arguments.threads);
  std::vector<ReplaySource> sources;
  Experiment const experiment = load_for_replay(request, sources);
  std::filesystem::path const output = arguments.out.empty() ? std::filesystem::path(experiment.name() + "_replay.h5")
                                                             : std::filesystem::path(arguments.out);
  refuse_other_output(output);
  note_start(session, experiment.name() + ": simulated beside its recordings", experiment, request.threads);
  Replay const replay = replay_of(experiment.parts(), *experiment.parts().rollout, sources, request.threads.count);
  session.result(replay_text(replay, session.result_ink()));
  session.document(replay_json(replay));
  if (!arguments.csv.empty()) {
    std::string const text = replay_csv(replay);
    TempFile file(arguments.csv);
    file.write_at(0, text.data(), text.size());
    file.publish();
    session.note(session.topic_line("wrote", printable(arguments.csv)));
  }
  write_replay_file(experiment, replay, output, request.threads);
  note_whereabouts(session, "wrote", output, session.options().json);
  return ExitCode::ok;
}

}  // namespace

void add_replay(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = app.add_subcommand(
      "replay",
      "Simulates every recording in its own loop, from its own reference, and sets it beside the measurement.");
  command->footer(
      "  torquescope replay lab.toml                  as least squares identifies it\n"
      "  torquescope replay lab_diagnosis.h5          before and after what was named\n"
      "  torquescope replay lab.h5 other.csv --json -\n"
      "  torquescope describe loop                    which controller, and what lies between it and the joint\n");
  command->add_option("SOURCE", arguments->source, "job file, or a result of run or diagnose")->required();
  command->add_option("RECORDING", arguments->recordings, "recordings in place of those of recording.validate");
  command->add_option("--job", arguments->job, "of a result: its job file, where the recordings' paths begin")
      ->type_name("JOB.toml");
  command->add_option("--estimator", arguments->estimator, "of a result of run: this one alone")->type_name("NAME");
  add_result_option(*command, arguments->out);
  command->add_option("--csv", arguments->csv, "every sample of every channel, measured and simulated")
      ->type_name("C.csv")
      ->group("results");
  add_json_option(*command, chosen);
  add_threads_option(*command, arguments->threads);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return replay_source(*arguments, session); };
  });
}

}  // namespace torquescope
