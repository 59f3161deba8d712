#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <charconv>
#include <map>

#include "engine/app/commands/command.hpp"
#include "engine/app/exit_codes.hpp"

namespace torquescope {

namespace {

// a word out of several; the help page shows the words and the default, and shells offer them
template <class Choice>
void add_word_option(CLI::App& command, std::string const& name, Choice& target,
                     std::map<std::string, Choice> const& words, std::string const& meaning) {
  std::vector<std::string> choices;
  for (auto const& entry : words) choices.push_back(entry.first);
  auto const store = [&target, words](std::string const& word) { target = words.at(word); };
  command.add_option_function<std::string>(name, store, meaning)
      ->check([choices, words](std::string const& word) {
        return words.contains(word) ? "" : fmt::format("\"{}\" is none of {}", word, fmt::join(choices, ", "));
      })
      ->type_name(fmt::format("{}", fmt::join(choices, "|")))
      ->group("terminal");
}

// why CLI11 must refuse the text; empty: it need not
std::string no_whole_number_from_one(std::string const& text) {
  int value = 0;
  auto const [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  bool const fits = failure == std::errc{} && end == text.data() + text.size() && value >= 1 && value <= 100'000;
  return fits ? "" : fmt::format("\"{}\" is no whole number from 1 to 100000", text);
}

std::string no_seconds(std::string const& text) {
  double value = 0.0;
  auto const [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  bool const fits = failure == std::errc{} && end == text.data() + text.size() && value > 0.0 && value < 1e9;
  return fits ? "" : fmt::format("\"{}\" is no number of seconds above 0", text);
}

}  // namespace

void add_colour_option(CLI::App& command, ChosenCommand& chosen) {
  add_word_option<ColourChoice>(
      command, "--color", chosen.session.colour,
      {{"auto", ColourChoice::automatic}, {"always", ColourChoice::always}, {"never", ColourChoice::never}},
      "colours; beats NO_COLOR [auto]");
}

void add_progress_option(CLI::App& command, ChosenCommand& chosen) {
  add_word_option<ProgressChoice>(command, "--progress", chosen.session.progress,
                                  {{"auto", ProgressChoice::automatic},
                                   {"bar", ProgressChoice::bar},
                                   {"lines", ProgressChoice::lines},
                                   {"none", ProgressChoice::none}},
                                  "how far it is; a bar needs a terminal [auto]");
}

void add_quiet_option(CLI::App& command, ChosenCommand& chosen) {
  command.add_flag("-q,--quiet", chosen.session.quiet, "print nothing but errors and verdicts")->group("terminal");
}

void add_json_option(CLI::App& command, ChosenCommand& chosen) {
  command.add_option("--json", chosen.session.json, "the same as data; - is stdout, without the tables")
      ->type_name("FILE")
      ->group("results");
}

void add_exit_code_option(CLI::App& command, bool& exit_code) {
  std::string codes;
  for (auto const& [code, words] : verdict_codes())
    codes += fmt::format("{}{} {}", codes.empty() ? "" : "; ", static_cast<int>(code), words);
  command.add_flag("--exit-code", exit_code, "the verdict as exit code: " + codes)->group("results");
}

void add_result_option(CLI::App& command, std::string& out) {
  command.add_option("-o,--out", out, "result file, HDF5 [NAME.h5 in this folder]")
      ->type_name("R.h5")
      ->check([](std::string const& name) {
        return name == "-"
                   ? "a result is a file of HDF5, which cannot go through a pipe; --json - writes the same as data"
                   : "";
      })
      ->group("results");
}

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("-j,--threads", threads, "threads [OMP_NUM_THREADS, SLURM_CPUS_PER_TASK, all]")
      ->type_name("N")
      ->check(no_whole_number_from_one)
      ->group("machine");
}

void add_seconds_option(CLI::App& command, std::string const& name, double& seconds, std::string const& meaning) {
  command.add_option(name, seconds, meaning)->type_name("S")->check(no_seconds)->group("machine");
}

void add_full_disk_option(CLI::App& command, bool& allow_full_disk) {
  command.add_flag("--allow-full-disk", allow_full_disk, "begin although the result does not seem to fit on the disk")
      ->group("machine");
}

void add_mixed_option(CLI::App& command, bool& allow_mixed) {
  command
      .add_flag("--allow-mixed", allow_mixed,
                "go on from segments or a result of another program, or segments of another job text; bits may differ")
      ->group("machine");
}

}  // namespace torquescope
