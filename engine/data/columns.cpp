#include "engine/data/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "engine/data/column_suggestion.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/repeated_names.hpp"

namespace torquescope {
namespace {

std::vector<std::string> const& known_channels() {
  static std::vector<std::string> const names = [] {
    std::vector<std::string> all{"time", "position", "torque", "reference", "velocity", "acceleration"};
    all.insert(all.end(), input_channels().begin(), input_channels().end());
    return all;
  }();
  return names;
}

bool is_input(std::string const& channel) {
  auto const& inputs = input_channels();
  return std::find(inputs.begin(), inputs.end(), channel) != inputs.end();
}

std::string listed(std::vector<std::string> const& names) {
  constexpr std::size_t most_shown = 40;
  std::string text;
  for (std::size_t k = 0; k < std::min(names.size(), most_shown); ++k) text += (k == 0 ? "" : ", ") + names[k];
  return names.size() > most_shown ? fmt::format("{} and {} more", text, names.size() - most_shown) : text;
}

bool ends_in(std::string const& path, std::string const& name) {
  return path == name || (path.size() > name.size() && path.ends_with("/" + name));
}

class ColumnPicker {
 public:
  ColumnPicker(RawTable const& table, RecordingOptions const& options, Section const& section, TorqueColumn torque)
      : table_(table), options_(options), section_(section), torque_(torque) {}

  Channels pick() {
    check_mapping();
    Channels channels;
    auto mapping = options_.columns;
    if (!options_.simulated_torque.empty()) mapping["simulated_torque"] = options_.simulated_torque;
    if (!options_.simulated_position.empty()) mapping["simulated_position"] = options_.simulated_position;
    std::map<std::size_t, std::string> channel_of_column;
    for (auto const& [channel, column] : mapping) {
      // pulses of one recording need not be columns of the others
      if (is_input(channel) && !has_column(column)) continue;
      auto const index = find(channel, column);
      if (!index) continue;
      auto const [other, is_new] = channel_of_column.emplace(*index, channel);
      if (!is_new)
        add(ExitCode::bad_job, fmt::format("{} and {} are both \"{}\"", other->second, channel, column), channel,
            "name two different columns");
      channels[channel] = {table_.names[*index], table_.columns[*index]};
    }
    if (!problems_.empty()) throw Error(std::move(problems_));
    return channels;
  }

 private:
  void check_mapping() {
    if (options_.columns.empty()) {
      add(ExitCode::bad_job,
          fmt::format("recording.columns does not say which columns of {} are position and torque", file_name(table_)),
          "", columns_advice(table_.names));
      problems_.back().notes.push_back("the file has: " + listed(table_.names));
      throw Error(std::move(problems_));
    }
    for (auto const& [channel, column] : options_.columns) check_channel(channel);
    bool const has_position = options_.columns.contains("position"),
               has_velocity = options_.columns.contains("velocity");
    if (!has_position && !has_velocity) missing("position", "columns names no position");
    if (!has_position && has_velocity && options_.columns.contains("reference"))
      add(ExitCode::bad_job, "reference without position: a velocity alone does not say where the joint stood",
          "reference", "take reference out of columns, or name the position column");
    if (torque_ == TorqueColumn::required && !options_.columns.contains("torque"))
      missing("torque", "columns names no torque");
    bool const has_time = options_.columns.contains("time"), has_rate = options_.rate_hz > 0;
    if (!has_time && !has_rate) {
      missing("time", "columns names no time, and there is no rate_hz");
      problems_.back().help += (problems_.back().help.empty() ? "" : "; ") +
                               std::string("without a time column: rate_hz = <samples per second>");
    }
    if (has_time && has_rate)
      add(ExitCode::bad_job, fmt::format("rate_hz = {:g} beside a time column", options_.rate_hz), "time",
          "delete rate_hz, or columns.time when its stamps are worthless");
    if (options_.columns.contains("acceleration") && !options_.columns.contains("velocity"))
      add(ExitCode::bad_job, "acceleration without velocity", "acceleration",
          "name the velocity column too, or let both be derived from position");
  }

  void check_channel(std::string const& channel) {
    auto const& known = known_channels();
    if (std::find(known.begin(), known.end(), channel) != known.end()) return;
    add(ExitCode::bad_job, fmt::format("unknown channel \"{}\"", channel), channel, "channels: " + listed(known));
    auto const similar = closest_name(channel, known);
    if (!similar.empty()) problems_.back().caret_note = fmt::format("did you mean \"{}\"?", similar);
  }

  void missing(std::string const& channel, std::string what) {
    add(ExitCode::bad_job, std::move(what), channel, mapping_advice(channel, table_.names));
    problems_.back().notes.push_back("the file has: " + listed(table_.names));
  }

  bool has_column(std::string const& column) const {
    auto const is_it = [&](std::string const& name) { return ends_in(name, column); };
    return std::any_of(table_.names.begin(), table_.names.end(), is_it) ||
           std::any_of(table_.unusable.begin(), table_.unusable.end(),
                       [&](auto const& one) { return is_it(one.name); });
  }

  std::optional<std::size_t> find(std::string const& channel, std::string const& column) {
    std::vector<std::size_t> same, ending;
    for (std::size_t c = 0; c < table_.names.size(); ++c) {
      if (table_.names[c] == column) same.push_back(c);
      if (ends_in(table_.names[c], column)) ending.push_back(c);
    }
    auto const& found = same.empty() ? ending : same;
    if (found.size() == 1) return found.front();
    if (found.empty())
      not_found(channel, column);
    else
      add(ExitCode::bad_data, fmt::format("{} has {} columns called \"{}\"", file_name(table_), found.size(), column),
          channel, same.empty() ? "write the whole path: " + table_.names[found[0]] : "rename one of them in the file");
    return {};
  }

  std::vector<std::string> repeats_of(std::string const& column) const {
    std::vector<std::string> same;
    for (auto const& name : table_.names)
      if (name != column && without_repeat(name) == column) same.push_back(name);
    return same;
  }

  void not_found(std::string const& channel, std::string const& column) {
    for (auto const& unusable : table_.unusable) {
      if (!ends_in(unusable.name, column)) continue;
      add(ExitCode::bad_data, fmt::format("column \"{}\" of {} {}", column, file_name(table_), unusable.reason),
          channel, unusable.line > 0 ? "correct or delete that line" : "");
      problems_.back().place = bad_data("", table_.path, unusable.line, "").place;
      return;
    }
    add(ExitCode::bad_job, fmt::format("no column \"{}\" in {}", column, file_name(table_)), channel, "");
    problems_.back().notes.push_back("the file has: " + listed(table_.names));
    auto const similar = closest_name(column, table_.names);
    if (auto const same = repeats_of(column); !same.empty()) {
      problems_.back().code = ExitCode::bad_data;
      problems_.back().what = fmt::format("{} has {} columns called \"{}\"", file_name(table_), same.size(), column);
      problems_.back().help = fmt::format("write one of \"{}\", in the order of the file", fmt::join(same, "\", \""));
    } else if (similar.empty())
      problems_.back().help = mapping_advice(channel, table_.names);
    else
      problems_.back().caret_note = fmt::format("did you mean \"{}\"?", similar);
  }

  void add(ExitCode code, std::string what, std::string const& channel, std::string help) {
    bool const is_option = channel.starts_with("simulated_");
    Problem problem{code, std::move(what), section_.where(is_option ? channel : "columns")};
    problem.key = is_option ? "recording." + channel : "recording.columns" + (channel.empty() ? "" : "." + channel);
    problem.help = std::move(help);
    problems_.push_back(std::move(problem));
  }

  RawTable const& table_;
  RecordingOptions const& options_;
  Section const& section_;
  TorqueColumn torque_;
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<std::string> const& input_channels() {
  static std::vector<std::string> const names{"added_command", "external_torque", "enabled"};
  return names;
}

std::string file_name(RawTable const& table) { return std::filesystem::path(table.path).filename().string(); }

std::vector<double> const& values_of(RawTable const& table, std::string const& column) {
  auto const at = std::find(table.names.begin(), table.names.end(), column) - table.names.begin();
  return table.columns.at(static_cast<std::size_t>(at));
}

Channels pick_channels(RawTable const& table, RecordingOptions const& options, Section const& section,
                       TorqueColumn torque) {
  return ColumnPicker(table, options, section, torque).pick();
}

}  // namespace torquescope
