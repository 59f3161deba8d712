// torquescope: reads the command line, does the work of one command, and turns whatever happens into an exit code.

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "engine/app/command_line.hpp"
#include "engine/app/failure.hpp"
#include "engine/app/terminal/interrupt.hpp"

namespace {

using namespace torquescope;

ExitCode run_command(std::vector<std::string> const& words, Session const*& session) {
  // lives as long as the process: errors are printed through it after everything else is gone
  static ParsedCommandLine parsed;
  parse_command_line(words, parsed);
  if (parsed.text) {
    std::fputs(parsed.text->c_str(), stdout);
    flush_stdout();
    return ExitCode::ok;
  }
  static Session const chosen_session(parsed.chosen.session);
  session = &chosen_session;
  ExitCode const code = parsed.chosen.work(chosen_session);
  flush_stdout();
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> const words(argv + 1, argv + (argc > 0 ? argc : 1));
  ignore_write_signals();
  Session const first_session(session_options_of(words));
  Session const* session = &first_session;
  try {
    return static_cast<int>(run_command(words, session));
  } catch (...) {
    auto const problems = problems_of(std::current_exception());
    session->errors(problems);
    std::fflush(stdout);
    std::fflush(stderr);
    // after a failed write HDF5's own exit handlers may crash and replace the exit code
    ::_exit(static_cast<int>(problems.front().code));
  }
}
