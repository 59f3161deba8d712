// From the rows of a file to an evenly sampled recording in SI units.

#include "engine/data/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/data/columns.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/gaps.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/data/resample.hpp"
#include "engine/data/sampling.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

constexpr std::size_t fewest_rows = 16;
constexpr double worth_a_warning = 0.001;  // share of time at a torque limit

void check_options(RecordingOptions const& options, Section const& section) {
  std::vector<Problem> problems;
  auto const check_unit = [&](char const* key, double value) {
    if (std::isfinite(value) && value != 0.0) return;
    problems.push_back(problem_at(section, key, fmt::format("{} = {:g} would erase the signal", key, value),
                                  "write the SI value of one unit of the column; 1 when it is in SI units already"));
  };
  check_unit("torque_per_unit", options.torque_per_unit);
  check_unit("position_per_unit", options.position_per_unit);
  if (!problems.empty()) throw Error(std::move(problems));
}

void check_rows(RawTable const& table) {
  std::size_t const n_rows = table.columns.empty() ? 0 : table.columns.front().size();
  validate(n_rows >= fewest_rows, [&] {
    return bad_data(fmt::format("{} has {} samples; at least {} are needed", file_name(table), n_rows, fewest_rows),
                    table.path, 0, "record some seconds, with several reversals and speeds");
  });
}

void check_moves(Channels const& channels, RawTable const& table) {
  std::vector<Problem> problems;
  for (auto const* name : {"position", "torque", "velocity", "acceleration", "simulated_torque"}) {
    auto const channel = channels.find(name);
    if (channel == channels.end()) continue;
    auto const [least, most] = std::minmax_element(channel->second.values.begin(), channel->second.values.end());
    if (*least != *most) continue;
    auto problem =
        bad_data(fmt::format("\"{}\" never changes: {} is {:g} in every row", channel->second.column, name, *least),
                 table.path, 0, "name the right column, or record a motion");
    problem.key = fmt::format("recording.columns.{}", name);
    problems.push_back(std::move(problem));
  }
  if (!problems.empty()) throw Error(std::move(problems));
}

double unit_of(std::string const& channel, RecordingOptions const& options) {
  if (channel == "torque") return options.torque_per_unit;
  if (channel == "simulated_torque" || channel == "time") return 1.0;
  return options.position_per_unit;
}

// even sample times at which every channel is known: a delayed torque is not known at one end
std::vector<double> grid_times(Sampling const& sampling, double delay_s) {
  double const first = sampling.times.front() + std::max(0.0, delay_s);
  double const last = sampling.times.back() + std::min(0.0, delay_s);
  constexpr double rounding_steps = 1e-6;
  double const first_index = std::ceil((first - sampling.times.front()) * sampling.rate_hz - rounding_steps);
  double const last_index = std::floor((last - sampling.times.front()) * sampling.rate_hz + rounding_steps);
  std::vector<double> times;
  for (double i = first_index; i <= last_index; ++i) times.push_back(i / sampling.rate_hz);
  return times;
}

// `values` at the grid times; shifted: their stamps are `delay_s` later than the rows say
Eigen::VectorXd on_grid(std::vector<double> const& values, Sampling const& sampling, std::vector<double> const& grid,
                        double delay_s) {
  std::vector<double> kept, queries;
  kept.reserve(sampling.rows.size());
  for (std::size_t row : sampling.rows) kept.push_back(values[row]);
  if (sampling.even && delay_s == 0.0) {
    // the rows stand on the grid already
    auto const first = static_cast<std::size_t>(std::llround(grid.front() * sampling.rate_hz));
    return Eigen::Map<Eigen::VectorXd const>(kept.data() + first, static_cast<Eigen::Index>(grid.size()));
  }
  for (double time : grid) queries.push_back(std::clamp(time - delay_s, sampling.times.front(), sampling.times.back()));
  auto const found = interpolate(sampling.times, kept, queries);
  return Eigen::Map<Eigen::VectorXd const>(found.data(), static_cast<Eigen::Index>(found.size()));
}

Eigen::Index count_resampled(Sampling const& sampling, std::vector<double> const& grid) {
  if (sampling.even) return 0;
  constexpr double coincident_steps = 0.005;
  double const tolerance = coincident_steps / sampling.rate_hz;
  Eigen::Index count = 0;
  auto row = sampling.times.begin();
  for (double time : grid) {
    while (row != sampling.times.end() && *row < time - tolerance) ++row;
    count += row == sampling.times.end() || *row > time + tolerance;
  }
  return count;
}

std::vector<DataWarning> warnings_of(RowFacts const& facts, double rate_hz) {
  std::vector<DataWarning> warnings;
  auto const counted = [](Eigen::Index count, char const* what) {
    return count > 0 ? fmt::format(", {} {}", count, what) : std::string();
  };
  constexpr double told = 0.0005;  // of a step; below it is how the stamps were printed
  std::string const unevenness =
      facts.jitter > told ? fmt::format("uneven by {:.2g} % of a step", 100 * facts.jitter) : std::string("with gaps");
  if (facts.resampled > 0 || facts.repeated > 0)
    warnings.push_back({"jitter", fmt::format("time stamps {}, put on an even grid of {:g} Hz{}{}", unevenness, rate_hz,
                                              counted(facts.repeated, facts.repeated == 1 ? "repeated time stamp"
                                                                                          : "repeated time stamps"),
                                              counted(facts.missing, "missing"))});
  if (facts.torque_limit_share >= worth_a_warning)
    warnings.push_back(
        {"saturation", fmt::format("torque sits at its limit {:.2g} % of the time", 100 * facts.torque_limit_share)});
  return warnings;
}

}  // namespace

Recording make_recording(RawTable const& table, RecordingOptions const& options, Section const& section) {
  check_options(options, section);
  auto channels = pick_channels(table, options, section);
  check_rows(table);
  auto filled = close_gaps(channels, table, options);
  check_moves(channels, table);

  auto const time = channels.find("time");
  auto const sampling = time == channels.end() ? sampling_at(options.rate_hz, table.columns.front().size())
                                               : analyse_sampling(time->second.values, table);
  auto const grid = grid_times(sampling, options.delay_s);
  validate(grid.size() >= fewest_rows, [&] {
    return problem_at(
        section, "delay_s",
        fmt::format("delay_s = {:g} leaves {} of {} samples", options.delay_s, grid.size(), sampling.times.size()),
        "delays of joints are milliseconds: -0.004");
  });

  Recording recording;
  recording.name = file_name(table);
  recording.sha256 = table.sha256;
  recording.rate_hz = sampling.rate_hz;
  double const first_stamp = time == channels.end() ? 0.0 : time->second.values.front();
  recording.time_s =
      Eigen::Map<Eigen::VectorXd const>(grid.data(), static_cast<Eigen::Index>(grid.size())).array() + first_stamp;
  auto const take = [&](char const* name, Eigen::VectorXd& out, double delay_s) {
    auto const channel = channels.find(name);
    if (channel != channels.end())
      out = on_grid(channel->second.values, sampling, grid, delay_s) * unit_of(name, options);
  };
  take("position", recording.position, 0.0);
  take("torque", recording.torque, options.delay_s);
  take("reference", recording.reference, 0.0);
  take("velocity", recording.velocity, 0.0);
  take("acceleration", recording.acceleration, 0.0);
  take("simulated_torque", recording.simulated_torque, 0.0);

  recording.rows = sampling.facts;
  recording.rows.resampled = count_resampled(sampling, grid);
  recording.rows.encoder_step =
      quantisation_step(channels.at("position").values) * std::fabs(options.position_per_unit);
  recording.rows.torque_limit_share = limit_share(channels.at("torque").values);
  recording.warnings = std::move(filled);
  for (auto& warning : warnings_of(recording.rows, recording.rate_hz)) recording.warnings.push_back(std::move(warning));
  return recording;
}

}  // namespace torquescope
