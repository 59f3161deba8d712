#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/data/health/finding_text.hpp"
#include "engine/simulate/rollout/measured_drive.hpp"
#include "engine/workflows/servo_words.hpp"
#include "engine/workflows/servo_workflow.hpp"

namespace torquescope {
namespace {

using Level = CheckLine::Level;

// "mass_kg 0.5, 1": what a quantity is in these recordings; the number of values where they are many
std::string values_text(std::vector<SetEntry> const& entries, std::string const& name) {
  constexpr std::size_t most_values = 6;
  std::set<double> numbers;
  std::set<std::string> words;
  for (auto const& entry : entries) {
    if (auto const number = entry.numbers.find(name); number != entry.numbers.end()) numbers.insert(number->second);
    if (auto const word = entry.words.find(name); word != entry.words.end()) words.insert(word->second);
  }
  if (numbers.size() + words.size() > most_values)
    return fmt::format("{}: {} values", name, numbers.size() + words.size());
  std::string text = name;
  for (double const number : numbers) text += fmt::format("{} {:g}", text == name ? "" : ",", number);
  for (auto const& one : words) text += fmt::format("{} {}", text == name ? "" : ",", one);
  return text;
}

std::string quantities_text(std::vector<SetEntry> const& entries) {
  std::set<std::string> names;
  for (auto const& entry : entries) {
    for (auto const& [name, value] : entry.numbers) names.insert(name);
    for (auto const& [name, value] : entry.words) names.insert(name);
  }
  std::string text;
  for (auto const& name : names) text += (text.empty() ? "" : "; ") + values_text(entries, name);
  return text;
}

// of one number of [known] over all recordings; empty: nowhere known
std::string range_text(std::vector<SetEntry> const& entries, double TrackKnown::*member, char const* name,
                       char const* unit) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (auto const& entry : entries) {
    least = std::fmin(least, entry.known.*member);
    most = std::fmax(most, entry.known.*member);
  }
  if (!std::isfinite(least) || !std::isfinite(most)) return {};
  return least == most ? fmt::format("{} {:.4g} {}", name, least, unit)
                       : fmt::format("{} {:.4g} to {:.4g} {}", name, least, most, unit);
}

std::string known_text(ServoJob const& job) {
  std::string text;
  std::string const unit = unit_of_command(job), per_error = unit + "/rad";
  auto const add = [&](bool is_known, double TrackKnown::*member, char const* name, std::string const& unit_of_it) {
    if (!is_known) return;
    std::string const range = range_text(job.entries, member, name, unit_of_it.c_str());
    if (!range.empty()) text += (text.empty() ? "" : "; ") + range;
  };
  add(job.known.gravity_moment, &TrackKnown::gravity_moment, "gravity_moment", "N m");
  add(job.known.inertia, &TrackKnown::inertia, "inertia", "kg m2");
  add(job.known.command_gain, &TrackKnown::command_gain, "command_gain", per_error);
  add(job.known.command_limit, &TrackKnown::command_limit, "command_limit", unit);
  add(job.known.arm_length, &TrackKnown::arm_length, "arm_length", "m");
  add(job.known.temperature, &TrackKnown::temperature, "temperature", "deg C");
  return text.empty() ? "nothing" : text;
}

// the recorded command over the known one, by least squares where the drive is on and not at its limit; NaN: not known
double command_ratio(ServoJob const& job) {
  if (!job.has_torque || !job.known.command_gain) return std::numeric_limits<double>::quiet_NaN();
  double products = 0.0, squares = 0.0;
  LoopNumbers const loop = numbers_of(job.loop.form, job.loop.values);
  for (auto const& track : job.training) {
    Eigen::VectorXd const command = measured_drive(track, loop).command;
    double const most = std::min(loop.most, track.known.command_limit);
    for (Eigen::Index k = 0; k < command.size(); ++k) {
      if (!is_drive_on(track, k) || std::abs(command[k]) >= most) continue;
      products += track.torque[k] * command[k];
      squares += command[k] * command[k];
    }
  }
  return products / squares;
}

}  // namespace

std::vector<ServoRemark> notes_of(ServoJob const& job) {
  std::vector<ServoRemark> notes;
  DriveScales const scales = drive_scales(job.training, numbers_of(job.loop.form, job.loop.values));
  if (job.training.size() < 2) notes.push_back({ServoNote::few_recordings});
  if (!scales.has_load) notes.push_back({ServoNote::no_scale});
  if (scales.has_load && !scales.has_several_loads) notes.push_back({ServoNote::one_load});
  if (job.validation.empty()) notes.push_back({ServoNote::no_validation});
  if (!job.known.command_gain) notes.push_back({ServoNote::no_gain});
  bool const switches = std::any_of(job.training.begin(), job.training.end(), [](RolloutTrack const& track) {
    return track.enabled.size() > 0 && track.enabled.minCoeff() == 0.0;
  });
  if (!switches && job.command == DriveCommand::voltage) notes.push_back({ServoNote::always_on});
  // a tenth: what supplies sag by
  constexpr double tenth = 0.1;
  if (double const ratio = command_ratio(job); std::abs(ratio - 1.0) > tenth)
    notes.push_back({ServoNote::other_gain, ratio});
  return notes;
}

std::vector<CheckLine> check_servo(ServoJob const& job) {
  std::vector<CheckLine> lines;
  double seconds = 0.0;
  for (auto const& recording : job.recordings)
    seconds += static_cast<double>(recording.position.size()) / recording.rate_hz;
  lines.push_back({Level::ok, "recordings",
                   fmt::format("{} to fit, {} to judge; {:.4g} s at {:.4g} Hz, simulated at {:.4g} Hz",
                               job.training.size(), job.validation.size(), seconds, job.recordings.front().rate_hz,
                               1.0 / job.training.front().tick_s())});
  lines.push_back({Level::ok, "quantities", quantities_text(job.entries)});
  lines.push_back({Level::ok, "known", known_text(job)});
  for (auto const& remark : notes_of(job))
    lines.push_back(
        {remark.note == ServoNote::other_gain ? Level::warn : Level::note, "recordings", sentence_of(remark)});
  for (auto const& warning : warnings_of(job)) lines.push_back({Level::warn, "recording", warning});
  return lines;
}

}  // namespace torquescope
