#include "engine/experiment/job/not_a_job.hpp"

#include <fmt/format.h>

#include <string_view>

namespace torquescope {
namespace {

std::string kind_of(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (text.find('\0') != std::string_view::npos) return "holds no text";
  auto const first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '<' ? "is XML" : "";
}

}  // namespace

std::optional<Problem> not_a_job(std::string const& text, std::string const& file) {
  auto const kind = kind_of(text);
  if (kind.empty()) return std::nullopt;
  Problem problem;
  problem.what = fmt::format("{} {}, not a job", file, kind);
  problem.place.file = file;
  problem.help = "a job is a short text in TOML that names a recording: torquescope init RECORDING > job.toml";
  return problem;
}

}  // namespace torquescope
