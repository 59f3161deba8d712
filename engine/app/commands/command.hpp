#pragma once
// One file per command: it declares its options and, when it was chosen, does its work and returns the exit code.
//
// Use        add_run(app, chosen): parsing the command line leaves in `chosen` what to do
// Errors     the work throws Error; main() prints it and maps it to its exit code

#include <CLI/App.hpp>
#include <functional>
#include <string>

#include "engine/app/commands/chosen_command.hpp"
#include "engine/app/session.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

void add_run(CLI::App& app, ChosenCommand& chosen);
// `diagnose` does the work: the program's is diagnose() of workflows/workflows.hpp, tests bring their own
using DiagnoseWork = std::function<Diagnosis(Experiment const&, DiagnoseRequest const&, ProgressSink const&)>;
void add_diagnose(CLI::App& app, ChosenCommand& chosen, DiagnoseWork diagnose);
void add_replay(CLI::App& app, ChosenCommand& chosen);
void add_merge(CLI::App& app, ChosenCommand& chosen);
void add_status(CLI::App& app, ChosenCommand& chosen);
void add_submit(CLI::App& app, ChosenCommand& chosen);
void add_simulate(CLI::App& app, ChosenCommand& chosen);
void add_excite(CLI::App& app, ChosenCommand& chosen);
void add_init(CLI::App& app, ChosenCommand& chosen);
void add_check(CLI::App& app, ChosenCommand& chosen);
void add_show(CLI::App& app, ChosenCommand& chosen);
void add_report(CLI::App& app, ChosenCommand& chosen);
void add_compare(CLI::App& app, ChosenCommand& chosen);
void add_export(CLI::App& app, ChosenCommand& chosen);
void add_list(CLI::App& app, ChosenCommand& chosen);
void add_describe(CLI::App& app, ChosenCommand& chosen);
void add_completion(CLI::App& app, ChosenCommand& chosen);
void add_man(CLI::App& app, ChosenCommand& chosen);

// groups of the help page that several commands share
void add_colour_option(CLI::App& command, ChosenCommand& chosen);
void add_quiet_option(CLI::App& command, ChosenCommand& chosen);
void add_json_option(CLI::App& command, ChosenCommand& chosen);
// --exit-code of the commands that print a verdict
void add_exit_code_option(CLI::App& command, bool& exit_code);
void add_progress_option(CLI::App& command, ChosenCommand& chosen);
// --out of the commands that write a result file
void add_result_option(CLI::App& command, std::string& out);
// refuses everything but 1 .. 100 000, in our words; 0 stays for "not given"
void add_threads_option(CLI::App& command, int& threads);
// refuses what is no number above 0
void add_seconds_option(CLI::App& command, std::string const& name, double& seconds, std::string const& meaning);
// --allow-full-disk of the commands that write results
void add_full_disk_option(CLI::App& command, bool& allow_full_disk);
// --allow-mixed of the commands that go on from segments
void add_mixed_option(CLI::App& command, bool& allow_mixed);

}  // namespace torquescope
