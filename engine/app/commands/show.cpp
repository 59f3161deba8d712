#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "engine/app/commands/command.hpp"
#include "engine/app/result/paper_tables.hpp"
#include "engine/app/result/result_json.hpp"
#include "engine/app/result/result_tables.hpp"

namespace torquescope {

namespace {

ExitCode show_result(std::string const& file, Session const& session) {
  ResultSummary const summary = read_summary(file);
  Ink const& ink = session.result_ink();
  session.result(result_table(summary, ink) + paper_tables(summary, ink));
  session.result("\n" + estimator_lines(summary, ink) + "\n" + origin_lines(summary, ink));
  session.document(result_json(summary));
  return ExitCode::ok;
}

}  // namespace

void add_show(CLI::App& app, ChosenCommand& chosen) {
  auto const file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("show", "Prints the tables of a result file and how it was made.");
  command->footer(
      "  torquescope show crs_a465_joint.h5\n"
      "  torquescope show lab.h5 --json lab.json\n"
      "  torquescope show lab.h5 --json - | jq .estimators[0].parameters\n");
  command->add_option("R.h5", *file, "result file of torquescope run, HDF5")->required();
  add_json_option(*command, chosen);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback(
      [file, &chosen] { chosen.work = [file](Session const& session) { return show_result(*file, session); }; });
}

}  // namespace torquescope
