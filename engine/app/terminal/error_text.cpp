#include "engine/app/terminal/error_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {

namespace {

constexpr std::size_t most_shown = 20;
constexpr int beside_code = 5;  // columns of the page to the right of "[78]"

std::string spaces(int count) { return std::string(static_cast<std::size_t>(std::max(0, count)), ' '); }

// "error: what                         [78]"; a run that was stopped is no error
std::string headline(Problem const& problem, Ink const& ink) {
  std::string const lead = problem.code == ExitCode::stopped ? "" : "error: ";
  std::string const code = fmt::format("[{}]", static_cast<int>(problem.code));
  int const code_column = page_width() - beside_code;
  int const width = code_column - columns_of(code) - 1;
  auto const lines = wrap(printable(problem.what), width - columns_of(lead), width - columns_of(lead));
  std::string text;
  for (auto const& line : lines) {
    bool const first = text.empty();
    std::string shown = (first ? ink.error(lead) : spaces(columns_of(lead))) + ink.bold(line);
    if (first) {
      int const used = columns_of(lead) + columns_of(line);
      shown += spaces(std::max(1, code_column - columns_of(code) - used)) + code;
    }
    text += shown + "\n";
  }
  return text;
}

std::string place_line(SourcePlace const& place, Ink const& ink) {
  std::string where = printable(place.file);
  if (place.line > 0) where += fmt::format(":{}", place.line);
  if (place.line > 0 && place.column > 0) where += fmt::format(":{}", place.column);
  return "  --> " + ink.name(where) + "\n";
}

// code points begin .. begin + count of a text
std::string part_of(std::string const& text, int begin, int count) {
  std::string part;
  int index = -1;
  for (char const byte : text) {
    if ((static_cast<unsigned char>(byte) & 0xC0) != 0x80) ++index;
    if (index >= begin && index < begin + count) part += byte;
  }
  return part;
}

std::string source_excerpt(Problem const& problem, Ink const& ink) {
  SourcePlace const& place = problem.place;
  std::string const number = fmt::format("{}", place.line);
  std::string const gutter = spaces(columns_of(number)) + " | ";
  std::string line = printable(place.line_text);
  int const room = page_width() - columns_of(gutter);
  int caret = std::clamp(place.column - 1, 0, columns_of(line));
  int length = std::clamp(place.length, 1, std::max(1, columns_of(line) - caret));

  // a line that does not fit is shown around its caret
  if (columns_of(line) > room) {
    int const begin = std::max(0, std::min(caret - 10, columns_of(line) - room));
    line = part_of(line, begin, room);
    caret -= begin;
    length = std::min(length, room - caret);
  }
  std::string text = number + " | " + line + "\n";
  std::string const marks(static_cast<std::size_t>(std::max(1, length)), '^');
  std::string const note = printable(problem.caret_note);
  text += gutter + spaces(caret) + ink.error(marks);
  if (note.empty()) return text + "\n";
  if (caret + length + 1 + columns_of(note) <= room) return text + " " + note + "\n";
  return text + "\n" + hanging(gutter, note);
}

std::string problem_text(Problem const& problem, Ink const& ink) {
  std::string text = headline(problem, ink);
  if (!problem.place.file.empty()) text += place_line(problem.place, ink);
  bool const has_line = problem.place.line > 0 && problem.place.column > 0 && !problem.place.line_text.empty();
  if (has_line) text += source_excerpt(problem, ink);
  if (!has_line && !problem.caret_note.empty()) text += hanging("  ", printable(problem.caret_note));
  // what is to be copied stands below the help, in one line however long
  auto const to_copy = [](std::string const& note) { return note.starts_with("    "); };
  for (auto const& note : problem.notes)
    if (!to_copy(note)) text += hanging("  ", printable(note));
  if (!problem.help.empty()) text += hanging("  help: ", printable(problem.help));
  for (auto const& note : problem.notes)
    if (to_copy(note)) text += printable(note) + "\n";
  return text;
}

using Json = nlohmann::ordered_json;

Json text_or_null(std::string const& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json problem_json(Problem const& problem) {
  SourcePlace const& place = problem.place;
  return {{"code", static_cast<int>(problem.code)},
          {"file", text_or_null(place.file)},
          {"line", place.line > 0 ? Json(place.line) : Json(nullptr)},
          {"column", place.column > 0 ? Json(place.column) : Json(nullptr)},
          {"key", text_or_null(problem.key)},
          {"problem", problem.what},
          {"notes", problem.notes},
          {"suggestion", text_or_null(problem.caret_note)},
          {"help", text_or_null(problem.help)}};
}

}  // namespace

std::string error_text(std::vector<Problem> const& problems, Ink const& ink) {
  std::string text;
  std::size_t const shown = std::min(problems.size(), most_shown);
  for (std::size_t i = 0; i < shown; ++i) text += (i ? "\n" : "") + problem_text(problems[i], ink);
  if (problems.size() > shown) {
    text += fmt::format("\n{} problems, the first {} are shown\n", problems.size(), shown);
  } else if (problems.size() > 1) {
    text += fmt::format("\n{} problems\n", problems.size());
  }
  return text;
}

std::string error_json(std::vector<Problem> const& problems) {
  Json errors = Json::array();
  for (auto const& problem : problems) errors.push_back(problem_json(problem));
  Json const document = {{"schema", 1}, {"error", errors.front()}, {"errors", errors}};
  // texts may quote the bytes of a broken file
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace torquescope
