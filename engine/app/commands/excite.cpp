#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <system_error>

#include "engine/app/commands/command.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/base/parallel.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

struct ExciteArguments {
  std::string job;
  std::string out;
  int threads = 0;
};

ExitCode excite(ExciteArguments const& arguments, Session const& session) {
  std::error_code ignored;
  validate(!std::filesystem::exists(arguments.out, ignored), [&] {
    Problem problem;
    problem.code = ExitCode::exists;
    problem.what = arguments.out + " exists";
    problem.help = fmt::format("--out another name, or delete {}", arguments.out);
    return problem;
  });
  ExciteReport const report = excite_arm(arguments.job, arguments.out, choose_threads(arguments.threads).count);
  session.note(fmt::format("{}: {} parameters, {} motions tried\n", printable(report.robot), report.parameters,
                           count_text(static_cast<std::int64_t>(report.evaluations))));
  if (report.angle > 0.0) {
    constexpr double degrees = 180.0 / std::numbers::pi;
    session.note(fmt::format("angle              {:.3g} degrees, of random motions {:.3g}\n", degrees * report.angle,
                             degrees * report.usual_angle));
  }
  session.note(
      fmt::format("condition          {:.4g}, of random motions {:.4g}\n", report.condition, report.usual_condition));
  // of the information: standard errors shrink by its root
  session.note(fmt::format("standard errors    {:.3g} times those of random motions, in the geometric mean\n",
                           std::exp(0.5 * (report.usual_log_determinant - report.log_determinant))));
  session.note(fmt::format("wrote  {}  {} samples, {:.4g} s at {:.6g} Hz\n",
                           session.note_ink().name(printable(arguments.out)),
                           count_text(static_cast<std::int64_t>(report.samples)), report.seconds, report.rate_hz));
  return ExitCode::ok;
}

}  // namespace

void add_excite(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<ExciteArguments>();
  CLI::App* command = app.add_subcommand(
      "excite", "Searches the motion, within the arm's limits, from which its parameters can best be told.");
  command->footer(
      "  torquescope excite jobs/crs_a465_five_joints.toml --out motion.csv\n"
      "  torquescope excite arm.toml --out motion.csv --threads 4\n"
      "  torquescope describe excite\n");
  command->add_option("JOB.toml", arguments->job, "job file with model.robot, TOML")->required();
  command->add_option("-o,--out", arguments->out, "motion: t_s, q1_rad, dq1_rad_s, ddq1_rad_s2, q2_rad, ...")
      ->type_name("MOTION.csv")
      ->required()
      ->group("results");
  add_threads_option(*command, arguments->threads);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return excite(*arguments, session); };
  });
}

}  // namespace torquescope
