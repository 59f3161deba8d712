#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/app/commands/command.hpp"
#include "engine/app/commands/notes.hpp"
#include "engine/app/commands/shard_choice.hpp"
#include "engine/app/exit_codes.hpp"
#include "engine/app/phase_times.hpp"
#include "engine/app/result/diagnosis_text.hpp"
#include "engine/app/result/finished_result.hpp"
#include "engine/app/result/result_summary.hpp"
#include "engine/app/result/servo_text.hpp"
#include "engine/app/session_progress.hpp"
#include "engine/app/terminal/environment.hpp"
#include "engine/app/terminal/interrupt.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/base/heap.hpp"
#include "engine/base/quantity_text.hpp"
#include "engine/experiment/diagnosis_estimate.hpp"
#include "engine/experiment/foreign_file.hpp"
#include "engine/workflows/results/diagnosis_json.hpp"
#include "engine/workflows/results/diagnosis_reader.hpp"
#include "engine/workflows/servo_workflow.hpp"

namespace torquescope {

namespace {

struct DiagnoseArguments {
  std::string job;
  std::string out{};
  std::string columns{};
  std::string shard{};
  std::vector<std::string> leave_out{};
  int threads = 0;  // 0: not given
  bool all = false;
  bool allow_full_disk = false;
  bool exit_code = false;
};

// whatever the verdict, the diagnosis itself succeeded: a code tells the verdict only where somebody asks
ExitCode code_of(DiagnoseArguments const& arguments, Diagnosis const& diagnosis) {
  return arguments.exit_code ? code_of(diagnosis.verdict) : ExitCode::ok;
}

constexpr StopWords words_of_one{
    "stopping after the running step of the search",
    "stopped in the middle of a step that takes long: nothing was written, the same command begins anew"};

void print_baseline(Session const& session, Diagnosis const& diagnosis) {
  for (auto const& joint : diagnosis.joints) {
    if (joint.baseline.empty()) continue;  // given up before it was fitted: the verdict says why
    std::string const whose = diagnosis.joints.size() > 1 ? which_joint(joint) + ": " : "";
    std::string line =
        fmt::format("{}{} parameters; error {} train", whose, joint.baseline.size(), percent_text(joint.train_relerr));
    if (std::isfinite(joint.validation_relerr))
      line += fmt::format(", {} validation", percent_text(joint.validation_relerr));
    session.note(session.topic_line("baseline", line));
  }
}

void print_stages(Session const& session, std::vector<ProgressUpdate> const& stages) {
  for (auto const& stage : stages) {
    std::string const done =
        stage.counted.empty() ? "" : fmt::format("{} {}, ", count_text(stage.runs_done), stage.counted);
    session.note(session.topic_line(stage.stage, done + seconds_text(stage.seconds)));
  }
}

void print_diagnosis(Session const& session, Diagnosis const& diagnosis, std::string const& json, bool all) {
  session.note("\n");
  session.verdict(verdict_text(diagnosis, session.utf8(), session.result_ink()));
  session.result(evidence_text(diagnosis, {.all_candidates = all, .utf8 = session.utf8()}, session.result_ink()));
  session.document(json);
}

ExitCode write_columns(DiagnoseArguments const& arguments, Experiment const& experiment, Session const& session) {
  // made in seconds: nothing is kept, and nothing that may be dear is written over
  std::error_code ignored;
  validate(!std::filesystem::exists(std::filesystem::symlink_status(arguments.columns, ignored)), [&] {
    Problem problem{ExitCode::exists, arguments.columns + " exists"};
    problem.help = "--columns another name, or delete it";
    return problem;
  });
  DiagnoseRequest request;
  request.threads = choose_threads(arguments.threads);
  request.output = arguments.columns;
  note_start(session, experiment.diagnose_line(), experiment, request.threads);
  ColumnsReport const report = write_candidate_columns(experiment, request);
  session.note(
      session.topic_line("columns", fmt::format("of {} effects on {} rows; no diagnosis was made", report.effects,
                                                count_text(static_cast<std::int64_t>(report.rows)))));
  return ExitCode::ok;
}

// where the reason in words, the map and every effect that was weighed can be read
void note_more(Session const& session, std::filesystem::path const& result, bool is_shown) {
  if (is_shown) return;
  session.note(fmt::format("more   torquescope show {} --all\n", session.note_ink().name(printable(result.string()))));
}

ExitCode print_kept(DiagnoseArguments const& arguments, Session const& session, std::filesystem::path const& output,
                    std::string const& inputs_sha256) {
  look_at_result(output, [](ResultReader const& there) {
    read_diagnosis(there);
    read_verdict_json(there);
  });
  ResultReader const reader(output);
  Diagnosis const diagnosis = read_diagnosis(reader);
  print_diagnosis(session, diagnosis, read_verdict_json(reader), arguments.all);
  note_whereabouts(session, "kept", output, session.options().json);
  note_more(session, output, arguments.all);
  tidy_up(session, output, inputs_sha256);
  return code_of(arguments, diagnosis);
}

constexpr StopWords words_of_set{"stopping after the running fits", "stopped: nothing was written"};

// many recordings of drives, which share one set of parameters
ExitCode diagnose_recordings(Job job, DiagnoseArguments const& arguments, Session const& session) {
  validate(arguments.shard.empty() && arguments.columns.empty(), [] {
    Problem problem{ExitCode::usage,
                    "--shard and --columns are about one joint or arm, and the job has [[recordings]]"};
    problem.help = "leave them out";
    return problem;
  });
  // also while the recordings are read
  install_stop_signals(session.options().quiet ? StopNotice::silent : StopNotice::spoken, words_of_set);
  ServoJob const servo = [&] {
    SessionProgress const bar(session, "read");
    return read_servo_job(std::move(job));
  }();
  Beginning const beginning;
  ServoRequest request;
  request.threads = choose_threads(arguments.threads);
  request.output = !arguments.out.empty()      ? std::filesystem::path(arguments.out)
                   : servo.output.file.empty() ? std::filesystem::path(servo.experiment.name + ".h5")
                                               : std::filesystem::path(servo.output.file);
  request.leave_out = arguments.leave_out;
  request.stop_requested = stop_requested;
  session.note(session.topic_line(
      "job",
      fmt::format("{}: {} recordings to fit, {} to judge; {} parameters and the effects of drive and gear",
                  servo.experiment.name, servo.training.size(), servo.validation.size(), servo.regressor->size())));
  session.note(session.topic_line("threads", fmt::format("{} ({}), seed {}", request.threads.count,
                                                         request.threads.reason, servo.experiment.seed)));
  for (auto const& warning : warnings_of(servo)) session.note(session.topic_line("warning", warning));
  PhaseTimes phases(progress_settings(session).clock);
  ServoReport report;
  {
    SessionProgress print_progress(session);
    report = diagnose_servo(servo, request, [&](ProgressUpdate const& update) {
      phases.note(update);
      print_progress(update);
    });
  }
  print_stages(session, phases.finish());
  session.note("\n");
  session.verdict(servo_verdict_text(report, session.result_ink()));
  session.result(servo_text(report, arguments.all));
  session.document(servo_json(report));
  Ink const plain;
  write_servo_file(servo, report, request, {servo_verdict_text(report, plain), servo_text(report, true)}, beginning);
  note_whereabouts(session, "wrote", request.output, session.options().json);
  return arguments.exit_code ? code_of(report.verdict) : ExitCode::ok;
}

ExitCode diagnose_job(DiagnoseArguments const& arguments, Session const& session, DiagnoseWork const& diagnose_work) {
  keep_heap();
  if (Job job = read_job_file(arguments.job); has_recording_set(job))
    return diagnose_recordings(std::move(job), arguments, session);
  validate(arguments.leave_out.empty(), [] {
    Problem problem{ExitCode::usage, "--leave-out is about the recordings of [[recordings]], and the job has none"};
    problem.help = "leave it out, or write [[recordings]] (torquescope describe recordings)";
    return problem;
  });
  PhaseTimes phases(progress_settings(session).clock);
  // one process makes a diagnosis; others of a job array that was written for several have nothing to do
  if (ShardChoice const shard = choose_shard(arguments.shard, [](char const*) { return std::string(); });
      shard.index > 0) {
    session.note(session.topic_line("shard", fmt::format("{}/{}: a diagnosis is not divided, --shard 0/{} makes it",
                                                         shard.index, shard.count, shard.count)));
    return ExitCode::ok;
  }
  // also while the recordings are read
  install_stop_signals(session.options().quiet ? StopNotice::silent : StopNotice::spoken, words_of_one);
  Experiment const experiment = load_with_bar(session, arguments.job, Experiment::Purpose::diagnose);
  if (!arguments.columns.empty()) return write_columns(arguments, experiment, session);
  std::filesystem::path const output =
      arguments.out.empty() ? experiment.output_file() : std::filesystem::path(arguments.out);

  if (already_complete(output, experiment.inputs_sha256(), ResultKind::diagnosis)) {
    session.note(session.topic_line("job", experiment.diagnose_line()));
    session.note(session.topic_line(
        "done", fmt::format("already diagnosed: nothing runs again, the kept result is shown; --out another name, or "
                            "delete {}, to diagnose anew",
                            output.string())));
    return print_kept(arguments, session, output, experiment.inputs_sha256());
  }

  DiagnoseRequest request;
  request.threads = choose_threads(arguments.threads);
  request.output = output;
  request.stop_requested = stop_requested;
  request.tell = [&session](std::string const& topic, std::string const& text) {
    session.note(session.topic_line(topic, text));
  };
  request.allow_full_disk = arguments.allow_full_disk;
  note_start(session, experiment.diagnose_line(), experiment, request.threads);
  DiagnosisSize const size = diagnosis_size(experiment.parts());
  DiagnosisEstimate const estimate = estimate_diagnosis(size, request.threads.count);
  request.expected_seconds = estimate.seconds;
  session.note(session.topic_line("size", estimate_words(size, estimate)));
  if (auto const fewer = many_rows_warning(experiment.parts())) session.note(session.topic_line("warning", *fewer));
  Diagnosis const diagnosis = [&] {
    SessionProgress print_progress(session);
    return diagnose_work(experiment, request, [&](ProgressUpdate const& update) {
      phases.note(update);
      print_progress(update);
    });
  }();
  print_baseline(session, diagnosis);
  print_stages(session, phases.finish());
  print_diagnosis(session, diagnosis, diagnosis_json(diagnosis), arguments.all);
  note_whereabouts(session, "wrote", output, session.options().json);
  note_more(session, output, arguments.all);
  return code_of(arguments, diagnosis);
}

}  // namespace

void add_diagnose(CLI::App& app, ChosenCommand& chosen, DiagnoseWork diagnose_work) {
  auto const arguments = std::make_shared<DiagnoseArguments>();
  CLI::App* command = app.add_subcommand(
      "diagnose",
      "Finds the physics that a job's model lacks: where, which, how sure, and what it brings on held-out data.");
  command->footer(
      "  torquescope diagnose jobs/lab_joint_3.toml\n"
      "  torquescope diagnose jobs/servo_loads.toml --leave-out mass_kg\n"
      "  torquescope diagnose lab.toml --columns columns.h5\n");
  command->add_option("JOB.toml", arguments->job, "job file, TOML (torquescope describe diagnose)")->required();
  add_result_option(*command, arguments->out);
  add_json_option(*command, chosen);
  command->add_flag("--all", arguments->all, "show every effect that was weighed")->group("results");
  add_exit_code_option(*command, arguments->exit_code);
  command
      ->add_option("--columns", arguments->columns,
                   "write the columns of every effect on the job's recordings here (HDF5) and make no diagnosis: for "
                   "other methods, on equal terms")
      ->type_name("C.h5")
      ->group("results");
  command
      ->add_option("--shard", arguments->shard, "a diagnosis is not divided: 0/N makes it, of others nothing is asked")
      ->type_name("I/N")
      ->check(no_shard)
      ->group("machine");
  command
      ->add_option("--leave-out", arguments->leave_out,
                   "of a job with [[recordings]]: fits again without the recordings of each value of this quantity, "
                   "and says how these are simulated then: mass_kg, kp, motion")
      ->type_name("QUANTITY")
      ->group("results");
  add_threads_option(*command, arguments->threads);
  add_full_disk_option(*command, arguments->allow_full_disk);
  add_progress_option(*command, chosen);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen, diagnose_work = std::move(diagnose_work)] {
    chosen.work = [arguments, diagnose_work](Session const& session) {
      return diagnose_job(*arguments, session, diagnose_work);
    };
  });
}

}  // namespace torquescope
