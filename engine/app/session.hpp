#pragma once
// Where the words of one command go: results to stdout, everything else to stderr, a JSON document to its place.
//
// Rule       --quiet silences results and notes, never errors and verdicts; --json - leaves stdout to the document
//            alone
// Errors     Error 74 when the JSON file or stdout cannot be written

#include <string>
#include <string_view>
#include <vector>

#include "engine/app/terminal/colour.hpp"
#include "engine/app/terminal/progress.hpp"
#include "engine/base/error.hpp"

namespace torquescope {

struct SessionOptions {
  ColourChoice colour = ColourChoice::automatic;
  ProgressChoice progress = ProgressChoice::automatic;
  bool quiet = false;
  std::string json{};  // "" none, "-" stdout, else a file
};

class Session {
 public:
  explicit Session(SessionOptions options);

  SessionOptions const& options() const { return options_; }
  Ink const& result_ink() const { return result_ink_; }
  Ink const& note_ink() const { return note_ink_; }
  bool utf8() const { return utf8_; }

  void result(std::string_view text) const;      // stdout
  void verdict(std::string_view text) const;     // stdout, also with --quiet
  void note(std::string_view text) const;        // stderr
  void document(std::string const& json) const;  // when --json was given
  void errors(std::vector<Problem> const& problems) const;
  // "data     simulated, ...\n" with its topic in colour, wrapped
  std::string topic_line(std::string const& topic, std::string const& text) const;

 private:
  SessionOptions options_;
  Ink result_ink_, note_ink_;
  bool utf8_;
};

// throws Error 74 when what was printed did not arrive; a closed pipe (| head) is nobody's fault
void flush_stdout();

}  // namespace torquescope
