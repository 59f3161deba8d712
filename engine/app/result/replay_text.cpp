#include "engine/app/result/replay_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"
#include "engine/base/quantity_text.hpp"

namespace torquescope {

namespace {

using Align = TextTable::Align;

std::string unit_of(ReplayChannel channel, Replay const& replay) {
  std::string const length = replay.is_prismatic ? "m" : "rad";
  if (channel == ReplayChannel::torque) return replay.torque_unit;
  return channel == ReplayChannel::position ? length : length + "/s";
}

std::string value_text(double value, bool diverged) {
  return diverged ? "diverged" : std::isnan(value) ? "-" : short_number(value);
}

std::string share_text(double value, bool diverged) { return diverged || std::isnan(value) ? "" : percent_text(value); }

// a line for every model of a channel
void add_rows(Replay const& replay, RecordingReplay const& one, TextTable& table) {
  bool is_first = true;
  for (std::size_t c = 0; c < replay_channels; ++c) {
    auto const& channel = one.channels[c];
    if (channel.measured.size() == 0) continue;
    auto const which = static_cast<ReplayChannel>(c);
    for (std::size_t m = 0; m < channel.errors.size(); ++m) {
      auto const& error = channel.errors[m];
      bool const lost = one.diverged[m];
      if (!lost && std::isnan(error.rms)) continue;
      table.row({is_first ? printable(one.name) : "", m == 0 ? word(which) : "", replay.models[m],
                 count_text(error.samples), value_text(error.rms, lost), value_text(error.mae, lost),
                 unit_of(which, replay), share_text(error.relerr, lost)});
      is_first = false;
    }
  }
}

std::string drive_text(RecordingReplay const& one) {
  if (one.drive == TrackDrive::reference) {
    std::string text = printable(one.loop_words.empty() ? one.loop : one.loop_words);
    if (std::isfinite(one.loop_error))
      text += fmt::format("; on the measured positions it leaves {} of the torque", percent_text(one.loop_error));
    return text;
  }
  if (one.window_s <= 0.0) return printable(one.loop_words);
  return fmt::format("{}; it begins anew at the measured state every {}", printable(one.loop_words),
                     seconds_text(one.window_s));
}

}  // namespace

std::string replay_text(Replay const& replay, Ink const& ink) {
  TextTable table(
      {Align::left, Align::left, Align::left, Align::right, Align::right, Align::right, Align::left, Align::right},
      "  ");
  table.row({"recording", "channel", "model", "samples", "rms", "MAE", "", "error"});
  for (auto const& one : replay.recordings) add_rows(replay, one, table);
  std::string text = table.text(200);
  bool const any_windows = std::any_of(replay.recordings.begin(), replay.recordings.end(), [](auto const& one) {
    return one.drive == TrackDrive::torque && one.window_s > 0.0;
  });
  text += "  All samples count. error: rms over that of the torque, or of the motion about its mean" +
          std::string(any_windows ? ";\n  in windows of the position: over how far it leaves the straight way on.\n\n"
                                  : ".\n\n");
  for (auto const& one : replay.recordings) {
    text += fmt::format("  {}{}\n    loop     {}\n", ink.name(printable(one.name)),
                        one.is_validation ? " (validation)" : "", drive_text(one));
    if (std::isfinite(one.horizon_s))
      text += fmt::format("    horizon  {:.4g} s: replicates then differ as much as simulation and recording\n",
                          one.horizon_s);
    if (std::any_of(one.diverged.begin(), one.diverged.end(), [](bool lost) { return lost; }))
      text += "    diverged: the loop and the joint are not stable together; check [loop], units and signs\n";
  }
  return text;
}

}  // namespace torquescope
