#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <system_error>

#include "engine/app/commands/command.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

struct SimulateArguments {
  std::string job;
  std::string out;
};

ExitCode simulate_job(SimulateArguments const& arguments, Session const& session) {
  std::error_code ignored;
  validate(!std::filesystem::exists(arguments.out, ignored), [&] {
    Problem problem;
    problem.code = ExitCode::exists;
    problem.what = arguments.out + " exists";
    problem.help = fmt::format("--out another name, or delete {}", arguments.out);
    return problem;
  });
  SimulateReport const report = simulate_recording(arguments.job, arguments.out);
  session.note(fmt::format(
      "wrote  {}  {} samples, {:.4g} s at {:.6g} Hz, {}\n", session.note_ink().name(printable(arguments.out)),
      count_text(static_cast<std::int64_t>(report.samples)), report.seconds, report.rate_hz, bytes_text(report.bytes)));
  return ExitCode::ok;
}

}  // namespace

void add_simulate(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<SimulateArguments>();
  CLI::App* command =
      app.add_subcommand("simulate", "Makes the recording that a job's [simulate] describes, in closed loop.");
  command->footer(
      "  torquescope simulate jobs/crs_a465_joint.toml --out joint.csv\n"
      "  torquescope simulate lab.toml --out lab.h5\n"
      "  torquescope describe simulate\n");
  command->add_option("JOB.toml", arguments->job, "job file with [simulate], TOML")->required();
  command->add_option("-o,--out", arguments->out, "recording; CSV or HDF5 by its ending")
      ->type_name("REC.csv|REC.h5")
      ->required()
      ->group("results");
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return simulate_job(*arguments, session); };
  });
}

}  // namespace torquescope
