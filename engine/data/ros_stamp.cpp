#include "engine/data/ros_stamp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/data/delimited_text.hpp"

namespace torquescope {
namespace {

constexpr double seconds_per_nanosecond = 1e-9;

// "header.stamp." of "header.stamp.sec"; nothing: the name ends in no such word
std::optional<std::string> before_word(std::string const& name, std::initializer_list<std::string_view> words) {
  auto const lower = lower_case(name);
  for (auto word : words) {
    if (!lower.ends_with(word)) continue;
    auto const prefix = name.substr(0, name.size() - word.size());
    bool const word_begins = prefix.empty() || std::string_view("./_ ").find(prefix.back()) != std::string_view::npos;
    if (word_begins) return prefix;
  }
  return std::nullopt;
}

bool are_whole(std::vector<double> const& values, double least, double below) {
  return std::all_of(values.begin(), values.end(), [&](double value) {
    return std::isnan(value) || (value >= least && value < below && value == std::floor(value));
  });
}

std::string stamp_name(std::string prefix) {
  std::string const separator = prefix.empty() ? "" : prefix.substr(prefix.size() - 1);
  if (!prefix.empty()) prefix.pop_back();
  auto const lower = lower_case(prefix);
  if (lower.ends_with("stamp") || lower.ends_with("time")) return prefix;
  return prefix + separator + "stamp";
}

std::vector<double> joined(std::vector<double> const& seconds, std::vector<double> const& nanoseconds) {
  auto const known = std::find_if(seconds.begin(), seconds.end(), [](double value) { return !std::isnan(value); });
  double const first = known == seconds.end() ? 0.0 : *known;
  std::vector<double> stamps(seconds.size());
  for (std::size_t i = 0; i < stamps.size(); ++i)
    stamps[i] = (seconds[i] - first) + nanoseconds[i] * seconds_per_nanosecond;
  return stamps;
}

}  // namespace

void add_ros_stamps(RawTable& table) {
  constexpr double most_seconds = 1e11, one_second = 1e9;
  std::size_t const n_read = table.names.size();
  for (std::size_t s = 0; s < n_read; ++s) {
    auto const prefix = before_word(table.names[s], {"sec", "secs"});
    if (!prefix) continue;
    for (std::size_t n = 0; n < n_read; ++n) {
      if (before_word(table.names[n], {"nanosec", "nanosecs", "nsec", "nsecs"}) != prefix) continue;
      bool const is_stamp =
          are_whole(table.columns[s], -most_seconds, most_seconds) && are_whole(table.columns[n], 0, one_second);
      auto const name = stamp_name(*prefix);
      bool const taken = std::find(table.names.begin(), table.names.end(), name) != table.names.end();
      if (!is_stamp || taken) continue;
      auto stamps = joined(table.columns[s], table.columns[n]);
      table.remarks.push_back(
          fmt::format("\"{}\" was added: \"{}\" + \"{}\" in seconds, counted from the first \"{}\".", name,
                      table.names[s], table.names[n], table.names[s]));
      table.names.push_back(name);
      table.columns.push_back(std::move(stamps));
      if (!table.units.empty()) table.units.emplace_back("s");
      break;
    }
  }
}

std::string stamp_with_fractions(RawTable const& table, std::string const& seconds) {
  auto const prefix = before_word(seconds, {"sec", "secs"});
  if (!prefix) return "";
  auto const name = stamp_name(*prefix);
  bool const added = std::any_of(table.remarks.begin(), table.remarks.end(), [&](std::string const& remark) {
    return remark.starts_with(fmt::format("\"{}\" was added: \"{}\" + ", name, seconds));
  });
  return added ? name : "";
}

}  // namespace torquescope
