#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include "engine/app/commands/command.hpp"
#include "engine/app/exit_codes.hpp"
#include "engine/app/result/diagnosis_text.hpp"
#include "engine/app/result/paper_tables.hpp"
#include "engine/app/result/result_json.hpp"
#include "engine/app/result/result_tables.hpp"
#include "engine/app/result/verification_text.hpp"
#include "engine/base/confined.hpp"
#include "engine/base/packed_bytes.hpp"
#include "engine/workflows/results/diagnosis_reader.hpp"
#include "engine/workflows/results/servo_reader.hpp"

namespace torquescope {

namespace {

struct ShowArguments {
  std::string file;
  bool all = false;
  bool verify = false;
  bool exit_code = false;
};

Verdict show_diagnosis(ResultSummary const& summary, ShowArguments const& arguments, Session const& session) {
  look_at_result(summary.file, [](ResultReader const& there) {
    read_diagnosis(there);
    read_verdict_json(there);
  });
  ResultReader const reader(summary.file);
  Diagnosis const diagnosis = read_diagnosis(reader);
  Ink const& ink = session.result_ink();
  session.result(warning_lines(summary, ink));
  session.verdict(verdict_text(diagnosis, session.utf8(), ink));
  session.result(evidence_text(diagnosis, {.all_candidates = arguments.all, .utf8 = session.utf8()}, ink));
  session.result("\n" + diagnosed_model_text(diagnosis, ink) + "\n" + origin_lines(summary, ink));
  session.document(read_verdict_json(reader));
  return diagnosis.verdict;
}

ExitCode show_verification(ShowArguments const& arguments, Session const& session) {
  // in a process of its own: checksums do not keep out who computes them
  auto const read = [&arguments] {
    Verification const facts = verify_everything(arguments.file);
    return PackedWriter().text(verification_text(facts)).text(verification_json(facts)).take();
  };
  auto const packed = run_confined(read, limits_for_file(arguments.file, 60), [&arguments](std::string const& how) {
    return Problem{.code = ExitCode::bad_data,
                   .what = arguments.file + " is damaged: HDF5 " + how + " while reading it",
                   .help = "delete it and run the job again: the same command makes the same file"};
  });
  PackedReader answer(packed);
  session.result(answer.text());
  session.document(answer.text());
  return ExitCode::ok;
}

// the text that the diagnosis printed, and its document
ExitCode show_servo(ShowArguments const& arguments, Session const& session) {
  look_at_result(arguments.file, [](ResultReader const& there) { read_servo(there); });
  KeptServo const kept = read_servo(ResultReader(arguments.file));
  session.verdict(kept.verdict_text);
  session.result(kept.text);
  session.document(kept.json);
  return arguments.exit_code ? code_of(kept.verdict) : ExitCode::ok;
}

ExitCode show_result(ShowArguments const& arguments, Session const& session) {
  if (arguments.verify) return show_verification(arguments, session);
  look_at_result(arguments.file, [](ResultReader const& there) { has_servo(there); });
  if (has_servo(ResultReader(arguments.file))) return show_servo(arguments, session);
  ResultSummary const summary = read_summary(arguments.file);
  Ink const& ink = session.result_ink();
  if (summary.has_diagnosis) {
    Verdict const verdict = show_diagnosis(summary, arguments, session);
    return arguments.exit_code ? code_of(verdict) : ExitCode::ok;
  }
  validate(!arguments.exit_code, [&] {
    return Problem{.code = ExitCode::usage,
                   .what = arguments.file + " holds the runs of a job: there is no verdict for --exit-code",
                   .help = "torquescope diagnose JOB.toml gives one"};
  });
  session.result(result_table(summary, ink) + paper_tables(summary, ink));
  session.result("\n" + estimator_lines(summary, ink) + "\n" + origin_lines(summary, ink));
  session.document(result_json(summary));
  return ExitCode::ok;
}

}  // namespace

void add_show(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<ShowArguments>();
  CLI::App* command = app.add_subcommand("show", "Prints the tables of a result file and how it was made.");
  command->footer(
      "  torquescope show crs_a465_joint.h5\n"
      "  torquescope show lab.h5 --verify && cp lab.h5 /archive\n"
      "  torquescope show lab.h5 --json - | jq .estimators[0].parameters\n");
  command->add_option("R.h5", arguments->file, "result file of torquescope run or diagnose, HDF5")->required();
  command->add_flag("--all", arguments->all, "of a diagnosis, every effect that was weighed")->group("results");
  command->add_flag("--verify", arguments->verify, "read all of it and compare every checksum; exit code 65: damaged")
      ->group("results");
  add_exit_code_option(*command, arguments->exit_code);
  add_json_option(*command, chosen);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return show_result(*arguments, session); };
  });
}

}  // namespace torquescope
