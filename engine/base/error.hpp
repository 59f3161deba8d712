#pragma once
// What a user is told when a job, a recording or the machine is at fault: what, where, why, and what to write instead.
//
// Use        validate(cutoff_hz < nyquist_hz, [&] { return Problem{ExitCode::bad_job, "cutoff_hz = 600 is above"}; });
//            or collect several Problems and throw one Error: the user sees all of them at once.
// Style      lower case, the offending value shown, no stack, no "please"
// Threads    values; Error never crosses an OpenMP region (parallel.hpp carries it out)

#include <stdexcept>
#include <string>
#include <vector>

namespace torquescope {

// stable: scripts and Slurm wrappers depend on these numbers
enum class ExitCode {
  ok = 0,
  usage = 64,
  bad_data = 65,
  no_input = 66,
  internal = 70,
  exists = 73,
  io = 74,
  stopped = 75,
  bad_job = 78,
};

// where in a text file; line and column count from 1, 0 means unknown
struct SourcePlace {
  std::string file;
  int line = 0;
  int column = 0;
  int length = 0;         // characters to underline
  std::string line_text;  // the whole line, when it helps to show it
};

struct Problem {
  ExitCode code = ExitCode::bad_job;
  std::string what;                  // one line: the problem and the value
  SourcePlace place{};               // empty file: nowhere in particular
  std::string key{};                 // job key, "recording.torque_per_unit"
  std::vector<std::string> notes{};  // facts: "the file has: t_s, q_rad, i_A"; "    line" is to be copied
  std::string caret_note{};          // stands behind the caret: "did you mean ..."
  std::string help{};                // what to write or do instead
};

class Error : public std::runtime_error {
 public:
  explicit Error(Problem problem);
  explicit Error(std::vector<Problem> problems);  // not empty; the first one's code is the exit code
  std::vector<Problem> const& problems() const { return problems_; }
  ExitCode code() const { return problems_.front().code; }

 private:
  std::vector<Problem> problems_;
};

// throws Error{make_problem()} unless the condition holds; always on
template <class MakeProblem>
void validate(bool condition, MakeProblem&& make_problem) {
  if (!condition) throw Error(make_problem());
}

// the closest of the candidates within a third of its letters, or "": for "did you mean"
std::string closest_name(std::string const& word, std::vector<std::string> const& candidates);

}  // namespace torquescope
