#include "engine/app/exit_codes.hpp"

#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

constexpr ExitCode verdict_named{10}, verdict_class{11}, verdict_partly{12}, verdict_unexplained{13};

constexpr ExitCodeMeaning codes_of_commands[] = {
    {ExitCode::ok, "done"},
    {ExitCode::usage, "usage"},
    {ExitCode::bad_data, "bad data"},
    {ExitCode::no_input, "no such file"},
    {ExitCode::internal, "our fault"},
    {ExitCode::exists, "output exists"},
    {ExitCode::io, "disk"},
    {ExitCode::stopped, "stopped (run again)"},
    {ExitCode::bad_job, "bad job file"},
};

constexpr ExitCodeMeaning codes_of_verdicts[] = {
    {ExitCode::ok, "nothing missing"},
    {verdict_named, "named"},
    {verdict_class, "one of a class"},
    {verdict_partly, "partly explained"},
    {verdict_unexplained, "unexplained"},
    {ExitCode::bad_data, "insufficient, or data fault: the recording is to blame"},
};

}  // namespace

std::span<ExitCodeMeaning const> exit_codes() { return codes_of_commands; }

std::span<ExitCodeMeaning const> verdict_codes() { return codes_of_verdicts; }

ExitCode code_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::none:
      return ExitCode::ok;
    case Verdict::named:
      return verdict_named;
    case Verdict::one_of_class:
      return verdict_class;
    case Verdict::partly:
      return verdict_partly;
    case Verdict::unexplained:
      return verdict_unexplained;
    case Verdict::insufficient:
    case Verdict::data_fault:
      break;
  }
  return ExitCode::bad_data;
}

}  // namespace torquescope
