#include "engine/job/not_a_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace torquescope {
namespace {

// the first lines that are neither empty nor comments
std::string_view next_line(std::string_view& rest) {
  while (!rest.empty()) {
    auto const end = std::min(rest.find_first_of("\r\n"), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    auto const first = line.find_first_not_of(" \t");
    if (first != std::string_view::npos && line[first] != '#') return line.substr(first);
  }
  return {};
}

bool begins_with_number(std::string_view line) {
  auto const first = line.find_first_not_of(" \t\"+-.");
  return first != std::string_view::npos && line[first] >= '0' && line[first] <= '9';
}

// names, then numbers, both separated alike and without "key ="
bool is_table(std::string_view text) {
  std::string_view const names = next_line(text), numbers = next_line(text);
  if (names.empty() || names.find('=') != std::string_view::npos || numbers.find('=') != std::string_view::npos)
    return false;
  bool const separated = std::any_of(numbers.begin(), numbers.end(), [&](char letter) {
    return std::string_view(",;\t ").find(letter) != std::string_view::npos &&
           names.find(letter) != std::string_view::npos;
  });
  return separated && names.front() != '[' && begins_with_number(numbers);
}

std::string kind_of(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (text.starts_with("\x1f\x8b")) return "is packed by gzip";
  if (text.starts_with("\x89HDF\r\n")) return "is an HDF5 file";
  if (text.find('\0') != std::string_view::npos) return "holds no text";
  std::string_view rest = text;
  std::string_view const first = next_line(rest);
  if (first.starts_with("<")) return "is XML";
  return is_table(text) ? "is a table of numbers" : "";
}

}  // namespace

std::optional<Problem> not_a_job(std::string const& text, std::string const& file) {
  auto const kind = kind_of(text);
  if (kind.empty()) return std::nullopt;
  Problem problem;
  problem.what = fmt::format("{} {}, not a job", file, kind);
  problem.place.file = file;
  problem.help = "a job is a short text that names the recording; jobs/ has examples, and it begins so:";
  problem.notes = {"    [recording]", fmt::format("    train = '{}'", std::filesystem::path(file).filename().string()),
                   "    columns = {time = \"t_s\", position = \"q_rad\", torque = \"tau_Nm\"}"};
  return problem;
}

}  // namespace torquescope
