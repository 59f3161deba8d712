#include "engine/app/session.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "engine/app/terminal/environment.hpp"
#include "engine/app/terminal/error_text.hpp"
#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {

namespace {

void print(std::FILE* stream, std::string_view text) { std::fwrite(text.data(), 1, text.size(), stream); }

Error cannot_write(std::string const& where, int reason) {
  Problem problem;
  problem.code = ExitCode::io;
  problem.what = fmt::format("cannot write {}: {}", where, std::strerror(reason));
  problem.help = "free space or choose another place, then run the same command";
  return Error(problem);
}

void write_file(std::string const& name, std::string const& text) {
  std::FILE* file = std::fopen(name.c_str(), "we");
  if (!file) throw cannot_write(name, errno);
  print(file, text);
  bool const failed = std::ferror(file) != 0;
  if (std::fclose(file) != 0 || failed) throw cannot_write(name, errno);
}

}  // namespace

Session::Session(SessionOptions options)
    : options_(std::move(options)),
      result_ink_(use_colour(options_.colour, colour_facts(is_terminal(STDOUT_FILENO)))),
      note_ink_(use_colour(options_.colour, colour_facts(is_terminal(STDERR_FILENO)))),
      utf8_(locale_is_utf8()) {}

void Session::result(std::string_view text) const {
  if (!options_.quiet && options_.json != "-") print(stdout, text);
}

void Session::verdict(std::string_view text) const {
  if (options_.json != "-") print(stdout, text);
}

// what was said before comes before it where both go into one file
void Session::note(std::string_view text) const {
  if (options_.quiet) return;
  std::fflush(stdout);
  print(stderr, text);
}

void Session::document(std::string const& json) const {
  if (options_.json.empty()) return;
  if (options_.json == "-") {
    print(stdout, json);
  } else {
    write_file(options_.json, json);
  }
}

void Session::errors(std::vector<Problem> const& problems) const {
  print(stderr, error_text(problems, note_ink_));
  try {
    document(error_json(problems));
  } catch (Error const& unwritten) {
    print(stderr, "\n" + error_text(unwritten.problems(), note_ink_));
  }
}

std::string Session::topic_line(std::string const& topic, std::string const& text) const {
  bool const warns = topic == "warning";
  std::string const lead = pad_right(topic, 8) + " ";
  return hanging(warns ? note_ink_.warning(lead) : lead, printable(text));
}

void flush_stdout() {
  bool const failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (failed && errno != EPIPE) throw cannot_write("to standard output", errno);
}

}  // namespace torquescope
