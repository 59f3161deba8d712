#include "engine/workflows/replay_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/runs/provenance_writer.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/workflows/replay_workflow.hpp"
#include "engine/workflows/results/json_values.hpp"
#include "engine/workflows/results/study_writer.hpp"

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

std::string unit_of(ReplayChannel channel, Replay const& replay) {
  switch (channel) {
    case ReplayChannel::position:
      return replay.is_prismatic ? "m" : "rad";
    case ReplayChannel::velocity:
      return replay.is_prismatic ? "m/s" : "rad/s";
    case ReplayChannel::torque:
      break;
  }
  return replay.torque_unit;
}

std::string drive_word(RecordingReplay const& recording) {
  if (recording.drive == TrackDrive::reference) return "reference";
  return recording.window_s > 0.0 ? "windows" : "command";
}

void write_channel(ResultWriter& writer, std::string const& group, ReplayChannel which, ChannelReplay const& channel,
                   Replay const& replay) {
  std::string const unit = unit_of(which, replay);
  auto const n = static_cast<std::size_t>(channel.measured.size()), models = channel.simulated.size();
  writer.attribute(group, "unit", unit);
  writer.attribute(group, "signal_rms", channel.signal_rms);
  writer.numbers(group + "/measured", {n}, {channel.measured.data(), n}, {unit, word(which) + " as recorded"});
  writer.numbers_in_blocks(group + "/simulated", {models, n},
                           [&](std::size_t first, std::span<double> values) {
                             for (std::size_t row = 0; row * n < values.size(); ++row)
                               std::copy_n(channel.simulated[first + row].data(), n,
                                           values.begin() + static_cast<std::ptrdiff_t>(row * n));
                           },
                           {unit, word(which) + " as simulated, by model"});
  std::vector<std::int64_t> samples;
  std::vector<double> rms, mae, relerr;
  for (auto const& error : channel.errors) {
    samples.push_back(error.samples);
    rms.push_back(error.rms);
    mae.push_back(error.mae);
    relerr.push_back(error.relerr);
  }
  writer.whole_numbers(group + "/samples", {models}, samples, {"1", "samples behind each number: all"});
  writer.numbers(group + "/rms", {models}, rms, {unit, "rms of measured - simulated"});
  writer.numbers(group + "/mae", {models}, mae, {unit, "mean absolute error"});
  writer.numbers(group + "/relerr", {models}, relerr, {"1", "rms over signal_rms"});
}

Json channel_json(ReplayChannel which, ChannelReplay const& channel, Replay const& replay) {
  Json models = Json::array();
  for (std::size_t m = 0; m < channel.errors.size(); ++m) {
    auto const& error = channel.errors[m];
    models.push_back({{"model", replay.models[m]},
                      {"n", error.samples},
                      {"rms", json_number(error.rms)},
                      {"mae", json_number(error.mae)},
                      {"relerr", json_number(error.relerr)}});
  }
  return {
      {"unit", unit_of(which, replay)}, {"signal_rms", json_number(channel.signal_rms)}, {"models", std::move(models)}};
}

}  // namespace

void write_replay(ResultWriter& writer, Replay const& replay) {
  writer.attribute("/replay", "models", replay.models);
  writer.attribute("/replay", "before", static_cast<std::int64_t>(replay.before));
  writer.attribute("/replay", "after", static_cast<std::int64_t>(replay.after));
  writer.attribute("/replay", "joint", std::string(replay.is_prismatic ? "prismatic" : "revolute"));
  for (std::size_t i = 0; i < replay.recordings.size(); ++i) {
    auto const& one = replay.recordings[i];
    std::string const group = fmt::format("/replay/recording_{}", i + 1);
    auto const n = static_cast<std::size_t>(one.time_s.size());
    writer.attribute(group, "name", one.name);
    writer.attribute(group, "purpose", std::string(one.is_validation ? "validate" : "train"));
    writer.attribute(group, "rate_hz", one.rate_hz);
    writer.attribute(group, "samples", one.channels.front().errors.front().samples);
    writer.attribute(group, "drive", drive_word(one));
    writer.attribute(group, "window_s", one.window_s);
    writer.attribute(group, "loop", one.loop);
    writer.attribute(group, "loop_words", one.loop_words);
    writer.attribute(group, "loop_error", one.loop_error);
    writer.attribute(group, "horizon_s", one.horizon_s);
    writer.numbers(group + "/time", {n}, {one.time_s.data(), n}, {"s", "time"});
    std::vector<std::int64_t> diverged(one.diverged.begin(), one.diverged.end());
    writer.whole_numbers(group + "/diverged", {diverged.size()}, diverged, {"1", "1: this model's rollout diverged"});
    for (std::size_t c = 0; c < replay_channels; ++c) {
      auto const which = static_cast<ReplayChannel>(c);
      if (one.channels[c].measured.size() > 0)
        write_channel(writer, group + "/" + word(which), which, one.channels[c], replay);
    }
  }
}

void refuse_other_output(std::filesystem::path const& output) {
  std::error_code ignored;
  if (!std::filesystem::exists(output, ignored)) return;
  ResultReader const there(output);
  validate(there.exists("/replay") && !there.exists("/runs") && !there.exists("/diagnosis"), [&] {
    Problem problem{ExitCode::exists, output.string() + " is no earlier replay"};
    problem.help = "--out another name, or delete it";
    return problem;
  });
}

void write_replay_file(Experiment const& experiment, Replay const& replay, std::filesystem::path const& output,
                       ThreadChoice const& threads) {
  Beginning const beginning;
  ResultWriter writer(
      output, {.gzip = experiment.parts().output.compression == "gzip", .inputs_sha256 = experiment.inputs_sha256()});
  write_study(writer, experiment);
  write_replay(writer, replay);
  finish_result(writer, output, threads, beginning);
}

std::string replay_json(Replay const& replay) {
  Json recordings = Json::array();
  for (auto const& one : replay.recordings) {
    Json channels = Json::object();
    for (std::size_t c = 0; c < replay_channels; ++c)
      if (one.channels[c].measured.size() > 0)
        channels[word(static_cast<ReplayChannel>(c))] =
            channel_json(static_cast<ReplayChannel>(c), one.channels[c], replay);
    Json diverged = Json::array();
    for (bool const lost : one.diverged) diverged.push_back(lost);
    recordings.push_back({{"name", one.name},
                          {"purpose", one.is_validation ? "validate" : "train"},
                          {"rate_hz", json_number(one.rate_hz)},
                          {"drive", drive_word(one)},
                          {"window_s", json_number(one.window_s)},
                          {"loop", one.loop},
                          {"loop_words", one.loop_words},
                          {"loop_error", json_number(one.loop_error)},
                          {"horizon_s", json_number(one.horizon_s)},
                          {"diverged", std::move(diverged)},
                          {"channels", std::move(channels)}});
  }
  Json const document = {{"schema", 1},
                         {"models", replay.models},
                         {"before", replay.models[replay.before]},
                         {"after", replay.models[replay.after]},
                         {"recordings", std::move(recordings)}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string replay_csv(Replay const& replay) {
  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "recording,t_s");
  for (std::size_t c = 0; c < replay_channels; ++c) {
    auto const which = static_cast<ReplayChannel>(c);
    fmt::format_to(out, ",{}_measured", word(which));
    for (std::size_t m = 0; m < replay.models.size(); ++m) fmt::format_to(out, ",{}_model_{}", word(which), m + 1);
  }
  for (std::size_t i = 0; i < replay.recordings.size(); ++i) {
    auto const& one = replay.recordings[i];
    for (Eigen::Index k = 0; k < one.time_s.size(); ++k) {
      fmt::format_to(out, "\n{},{}", i + 1, one.time_s[k]);
      for (auto const& channel : one.channels) {
        auto const cell = [&](Eigen::VectorXd const& values) {
          if (values.size() > 0 && std::isfinite(values[k]))
            fmt::format_to(out, ",{:.9g}", values[k]);
          else
            text.push_back(',');
        };
        cell(channel.measured);
        for (std::size_t m = 0; m < replay.models.size(); ++m)
          cell(m < channel.simulated.size() ? channel.simulated[m] : Eigen::VectorXd());
      }
    }
  }
  text.push_back('\n');
  return fmt::to_string(text);
}

}  // namespace torquescope
