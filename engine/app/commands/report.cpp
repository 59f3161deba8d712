#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "engine/app/commands/command.hpp"
#include "engine/app/commands/results.hpp"
#include "engine/app/report/page_builder.hpp"
#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {

namespace {

struct ReportArguments {
  std::string result;
  std::string out{};
};

ExitCode report_result(ReportArguments const& arguments, Session const& session) {
  verify_before_page(arguments.result);
  std::filesystem::path page = arguments.out;
  if (page.empty()) page = std::filesystem::path(arguments.result).replace_extension(".html");
  build_page(arguments.result, page);
  session.result(fmt::format("{}\n", printable(page.string())));
  return ExitCode::ok;
}

}  // namespace

void add_report(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<ReportArguments>();
  CLI::App* command =
      app.add_subcommand("report", "Builds one self-contained HTML page with pictures from a result file.");
  command->footer(
      "  torquescope report crs_a465_joint.h5\n"
      "  torquescope report lab.h5 --out lab_monday.html\n"
      "  xdg-open $(torquescope report lab.h5)\n");
  command->add_option("R.h5", arguments->result, "result file of torquescope run or diagnose, HDF5")->required();
  command->add_option("-o,--out", arguments->out, "the page, HTML [R.html beside R.h5]")
      ->type_name("R.html")
      ->group("results");
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return report_result(*arguments, session); };
  });
}

}  // namespace torquescope
