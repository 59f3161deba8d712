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

struct CompareArguments {
  std::vector<std::string> results{};
  std::string out{};
};

ExitCode compare_results(CompareArguments const& arguments, Session const& session) {
  validate(arguments.results.size() > 1, [] {
    return Problem{.code = ExitCode::usage,
                   .what = "compare needs two results or more",
                   .help = "torquescope compare monday.h5 tuesday.h5; of one result: torquescope report"};
  });
  for (auto const& result : arguments.results) verify_before_page(result);
  std::filesystem::path page = arguments.out;
  if (page.empty()) page = std::filesystem::path(arguments.results.front()).replace_filename("compare.html");
  build_comparison(arguments.results, page);
  session.result(fmt::format("{}\n", printable(page.string())));
  return ExitCode::ok;
}

}  // namespace

void add_compare(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Builds one HTML page with several results side by side: verdicts, errors, estimates.");
  command->footer(
      "  torquescope compare monday.h5 tuesday.h5\n"
      "  torquescope compare joint_*.h5 --out joints.html\n");
  command->add_option("R.h5", arguments->results, "result files of torquescope run or diagnose, HDF5")->required();
  command->add_option("-o,--out", arguments->out, "the page, HTML [compare.html beside the first R.h5]")
      ->type_name("R.html")
      ->group("results");
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return compare_results(*arguments, session); };
  });
}

}  // namespace torquescope
