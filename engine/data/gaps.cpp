#include "engine/data/gaps.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/data/data_problem.hpp"

namespace torquescope {
namespace {

struct Missing {
  std::size_t count = 0, places = 0, first = 0;
};

Missing missing_of(std::vector<double>& values) {
  Missing missing;
  bool before = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    bool const now = !std::isfinite(values[i]);
    if (now) {
      if (missing.count++ == 0) missing.first = i;
      missing.places += !before;
      values[i] = std::numeric_limits<double>::quiet_NaN();
    }
    before = now;
  }
  return missing;
}

Problem refused(Channel const& channel, Missing const& missing, RawTable const& table, Channels const& channels) {
  auto problem = bad_data(
      fmt::format("{} value{} of \"{}\" {} not {}, first in {}", missing.count, missing.count == 1 ? "" : "s",
                  channel.column, missing.count == 1 ? "is" : "are", missing.count == 1 ? "a number" : "numbers",
                  row_name(table, missing.first)),
      table.path, line_of(table, missing.first),
      fmt::format("cut the recording there, or recording.gaps = \"fill\" (up to {:.0f} samples are filled, longer "
                  "stretches left out)",
                  longest_filled_gap));
  auto const time = channels.find("time");
  if (time != channels.end() && std::isfinite(time->second.values[missing.first]))
    problem.notes = {fmt::format("t = {:.3f} s", time->second.values[missing.first])};
  return problem;
}

}  // namespace

std::vector<DataWarning> missing_values(Channels& channels, RawTable const& table, RecordingOptions const& options) {
  std::vector<DataWarning> warnings;
  std::vector<Problem> problems;
  for (auto& [name, channel] : channels) {
    auto const missing = missing_of(channel.values);
    if (missing.count == 0) continue;
    // a stamp cannot be filled: it says where all other values of its row stand
    if (options.gaps == "error" || name == "time") {
      problems.push_back(refused(channel, missing, table, channels));
      if (name == "time") problems.back().help = "delete those lines: without its time a row has no place";
      continue;
    }
    warnings.push_back({"gaps", fmt::format("{} missing values of \"{}\" in {} places, first in {}", missing.count,
                                            channel.column, missing.places, row_name(table, missing.first))});
  }
  if (!problems.empty()) throw Error(std::move(problems));
  return warnings;
}

}  // namespace torquescope
