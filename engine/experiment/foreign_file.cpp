#include "engine/experiment/foreign_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "engine/base/error.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/store/h5.hpp"
#include "engine/store/result_reader.hpp"

namespace torquescope {

namespace {

// as a shell takes it for one word
std::string shell_word(std::filesystem::path const& path) {
  std::string const text = path.string();
  bool const plain = std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c >= 0x80 || std::string("._-/+=,@").find(static_cast<char>(c)) != std::string::npos;
  });
  return plain && !text.empty() ? text : "'" + text + "'";
}

// "good.toml" for "logs/good.csv.gz"
std::filesystem::path job_for(std::filesystem::path const& recording) {
  std::filesystem::path stem = recording.filename().stem();
  if (recording.extension() == ".gz") stem = stem.stem();
  return stem.string() + ".toml";
}

bool is_result(std::filesystem::path const& path) {
  try {
    if (!h5::is_hdf5(ReadFile(path))) return false;
    ResultReader const reader(path);
    return true;
  } catch (Error const&) {
    return false;
  }
}

bool is_job(std::filesystem::path const& path) {
  try {
    Job const job = read_job(path);
    return std::any_of(known_sections().begin(), known_sections().end(),
                       [&](std::string const& name) { return job.find(name) != nullptr; });
  } catch (Error const&) {
    return path.extension() == ".toml";
  }
}

bool is_called_a_table(std::filesystem::path const& path) {
  constexpr std::array endings{".csv", ".tsv", ".txt", ".dat", ".gz"};
  return std::find(endings.begin(), endings.end(), path.extension()) != endings.end();
}

// "CSV" or "JSON" for a table of numbers, "HDF5"; empty for what no reader takes
std::string recording_format(std::filesystem::path const& path) {
  constexpr std::size_t enough_for_signatures = 4096;
  auto const first_bytes = read_first_bytes(path, enough_for_signatures);
  for (auto const& reader : reader_choices()) {
    if (!reader.accepts(path, first_bytes)) continue;
    if (!reader.library.empty()) return reader.name == "hdf5" ? "HDF5" : "MATLAB";
    bool const is_compressed = first_bytes.starts_with("\x1f\x8b");
    try {  // any text may be a table, or a job with a mistake in it
      if (!is_compressed && read_table(path, {"recording", {}, {}}).columns.size() < 2) return {};
      return reader.name == "json" ? "JSON" : "CSV";
    } catch (Error const&) {  // a damaged table is a recording all the same
      return is_called_a_table(path) ? "CSV" : "";
    }
  }
  return {};
}

Problem no_job(std::filesystem::path const& path, std::string const& what, std::string help) {
  Problem problem;
  problem.what = fmt::format("{} is {}, not a job", path.string(), what);
  problem.help = std::move(help);
  return problem;
}

std::optional<Problem> foreign_as_job(std::filesystem::path const& path) {
  auto const word = shell_word(path);
  if (is_result(path))
    return no_job(path, "a result",
                  fmt::format("torquescope show {0} (tables), torquescope report {0} (a page)", word));
  auto const format = recording_format(path);
  if (format.empty()) return {};
  return no_job(path, fmt::format("a recording ({})", format),
                fmt::format("torquescope init {} > {}   drafts a job for it", word, shell_word(job_for(path))));
}

}  // namespace

Job read_job_file(std::filesystem::path const& path) {
  try {
    return read_job(path);
  } catch (Error const& error) {
    if (error.code() != ExitCode::bad_job) throw;
    auto const foreign = foreign_as_job(path);
    if (!foreign) throw;
    throw Error(*foreign);
  }
}

void refuse_no_recording(std::filesystem::path const& path) {
  std::error_code none;
  validate(std::filesystem::exists(path, none), [&] {
    Problem problem;
    problem.code = ExitCode::no_input;
    problem.what = fmt::format("no such file: {}", path.string());
    problem.help = "name a recording: CSV, JSON, HDF5 or MATLAB (torquescope list readers)";
    return problem;
  });
  if (!std::filesystem::is_regular_file(path, none)) return;  // the reader says so
  auto const word = shell_word(path);
  auto const refuse = [&](char const* what, std::string help) {
    Problem problem;
    problem.code = ExitCode::bad_data;
    problem.what = fmt::format("{} is {}, not a recording", path.string(), what);
    problem.help = std::move(help);
    throw Error(problem);
  };
  if (is_result(path)) refuse("a result", fmt::format("torquescope show {}", word));
  if (is_job(path)) refuse("a job already", fmt::format("torquescope check {}", word));
}

}  // namespace torquescope
