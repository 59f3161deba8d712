#include "engine/data/health/make_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "engine/data/block_lengths.hpp"
#include "engine/data/columns.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/encoder_step.hpp"
#include "engine/data/gaps.hpp"
#include "engine/data/health/channel_units.hpp"
#include "engine/data/health/clock.hpp"
#include "engine/data/health/integrated_position.hpp"
#include "engine/data/health/lone_rows.hpp"
#include "engine/data/health/no_command.hpp"
#include "engine/data/health/reference_channel.hpp"
#include "engine/data/health/register_coding.hpp"
#include "engine/data/health/repeated_rows.hpp"
#include "engine/data/health/sentinels.hpp"
#include "engine/data/health/slow_source.hpp"
#include "engine/data/health/standstill.hpp"
#include "engine/data/health/torque_signs.hpp"
#include "engine/data/health/velocity_channel.hpp"
#include "engine/data/health/wrapped_position.hpp"
#include "engine/data/health/wrong_rows.hpp"
#include "engine/data/levels.hpp"
#include "engine/data/own_clocks.hpp"
#include "engine/data/resample.hpp"
#include "engine/data/sampling.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

constexpr std::size_t fewest_rows = 16;

void check_encoding(RecordingOptions const& options, Section const& section, std::vector<Problem>& problems) {
  for (auto const& [channel, word] : options.encoding) {
    if (!is_encoding(word))
      problems.push_back(problem_at(section, "encoding",
                                    fmt::format("encoding.{} = \"{}\" is not known", channel, word),
                                    "plain, unsigned8, 10, 12, 14, 16, 24 or 32, sign_magnitude, sign_magnitude7 to 32 "
                                    "(all bits counted)"));
  }
}

void check_options(RecordingOptions const& options, Section const& section) {
  std::vector<Problem> problems;
  auto const check_unit = [&](char const* key, double value) {
    if (std::isfinite(value) && value != 0.0) return;
    problems.push_back(problem_at(section, key, fmt::format("{} = {:g} would erase the signal", key, value),
                                  "write the SI value of one unit of the column; 1 when it is in SI units already"));
  };
  auto const check_single = [&](char const* key, std::vector<double> const& numbers) {
    if (numbers.size() == 1) return;
    problems.push_back(problem_at(section, key,
                                  fmt::format("{} has {} numbers, and the job is about one joint", key, numbers.size()),
                                  "write one number; a list is for an arm: model.robot = \"ARM.toml\""));
  };
  check_single("torque_per_unit", options.torque_per_unit);
  check_single("delay_s", options.delay_s);
  check_single("zero", options.zero);
  if (options.torque_per_unit.size() == 1) check_unit("torque_per_unit", options.torque_factor());
  constexpr double longest_s = 10.0;
  if (std::any_of(options.delay_s.begin(), options.delay_s.end(), [](double s) { return std::abs(s) > longest_s; }))
    problems.push_back(problem_at(section, "delay_s", "delay_s lies outside -10 to 10 s",
                                  "delays of joints are milliseconds: -0.004"));
  check_unit("position_per_unit", options.position_per_unit);
  check_encoding(options, section, problems);
  bool const has_pairs = options.leave_out.size() % 2 == 0;
  for (std::size_t k = 0; has_pairs && k < options.leave_out.size(); k += 2)
    if (!(options.leave_out[k] < options.leave_out[k + 1]))
      problems.push_back(problem_at(section, "leave_out", "leave_out holds a stretch that ends before it begins",
                                    "write [[from, until]] in seconds"));
  if (!has_pairs)
    problems.push_back(
        problem_at(section, "leave_out", "leave_out holds no pairs", "write leave_out = [[1.0, 2.5], [7.0, 7.2]]"));
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
  bool const has_position = channels.contains("position");
  for (auto const* name : {has_position ? "position" : "velocity", "torque", "simulated_torque"}) {
    auto const channel = channels.find(name);
    if (channel == channels.end()) continue;
    auto const& values = channel->second.values;
    auto const known = known_rows(values);
    validate(known.size() >= fewest_rows, [&] {
      return bad_data(fmt::format("\"{}\" has {} values; at least {} are needed", channel->second.column, known.size(),
                                  fewest_rows),
                      table.path, 0, "name the right column");
    });
    double const first = values[known.front()];
    if (std::any_of(known.begin(), known.end(), [&](std::size_t row) { return values[row] != first; })) continue;
    auto problem =
        bad_data(fmt::format("\"{}\" never changes: {} is {:g} in every row", channel->second.column, name, first),
                 table.path, 0, "name the right column, or record a motion");
    problem.key = fmt::format("recording.columns.{}", name);
    problems.push_back(std::move(problem));
  }
  if (!problems.empty()) throw Error(std::move(problems));
}

double unit_of(std::string const& channel, RecordingOptions const& options) {
  if (channel == "torque") return options.torque_factor();
  auto const& inputs = input_channels();
  if (channel == "simulated_torque" || std::find(inputs.begin(), inputs.end(), channel) != inputs.end()) return 1.0;
  return channel == "velocity" ? options.velocity_factor() : options.position_per_unit;
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

// one channel's values where they are known, by time
struct KnownValues {
  std::vector<double> times, values;
  bool is_whole = true;  // no row of the sampling lacks its value
};

// A channel has its own rows where topics were merged: rows of other channels stand between them
KnownValues known_values(Examination const& exam, std::vector<double> const& values, Sampling const& sampling,
                         std::vector<std::size_t> const& sampled) {
  KnownValues known;
  known.is_whole = std::all_of(sampling.rows.begin(), sampling.rows.end(),
                               [&](std::size_t k) { return std::isfinite(values[sampled[k]]); });
  if (known.is_whole) {
    known.times = sampling.times;
    known.values.reserve(sampling.rows.size());
    for (std::size_t k : sampling.rows) known.values.push_back(values[sampled[k]]);
    return known;
  }
  std::vector<bool> is_sampled(values.size(), false);
  std::vector<double> time_of(values.size(), 0.0);
  for (std::size_t k = 0; k < sampling.rows.size(); ++k) {
    std::size_t const row = sampled[sampling.rows[k]];
    is_sampled[row] = true;
    time_of[row] = sampling.times[k];
  }
  double const first_s = exam.time_s[sampled[sampling.rows.front()]];
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isfinite(values[row])) continue;
    double const time = is_sampled[row] ? time_of[row] : exam.time_s[row] - first_s;
    if (!known.times.empty() && !(time > known.times.back())) continue;
    known.times.push_back(time);
    known.values.push_back(values[row]);
  }
  return known;
}

struct HoleyColumn {
  std::string name;
  bool tells_motion = true;
};

// where the grid has no value near: longer than the longest gap that is filled, in samples of the channel
void add_holes(KnownValues const& known, std::vector<double> const& grid, double rate_hz, double delay_s,
               HoleyColumn const& column, std::vector<LeftOutStretch>& left_out) {
  double const longest = (longest_filled_gap + 1.5) / rate_hz;
  auto const add = [&](double from, double until) {
    left_out.push_back({{from + delay_s, until + delay_s}, LeftOutReason::no_value, column.name, column.tells_motion});
  };
  if (known.times.front() > grid.front() + longest) add(grid.front(), known.times.front());
  for (std::size_t k = 1; k < known.times.size(); ++k)
    if (known.times[k] - known.times[k - 1] > longest) add(known.times[k - 1], known.times[k]);
  if (known.times.back() < grid.back() - longest) add(known.times.back(), grid.back());
}

Eigen::VectorXd on_grid(KnownValues const& known, Sampling const& sampling, std::vector<double> const& grid,
                        double delay_s) {
  auto const n = static_cast<Eigen::Index>(grid.size());
  if (sampling.even && known.is_whole && delay_s == 0.0) {
    // the rows stand on the grid already
    auto const first = static_cast<std::size_t>(std::llround(grid.front() * sampling.rate_hz));
    return Eigen::Map<Eigen::VectorXd const>(known.values.data() + first, n);
  }
  std::vector<double> queries;
  queries.reserve(grid.size());
  for (double time : grid) queries.push_back(std::clamp(time - delay_s, known.times.front(), known.times.back()));
  auto const found = interpolate(known.times, known.values, queries);
  return Eigen::Map<Eigen::VectorXd const>(found.data(), n);
}

void take_other_joints(Examination& exam, Sampling const& sampling, std::vector<std::size_t> const& sampled,
                       std::vector<double> const& grid, Recording& recording) {
  auto const found = other_joint_columns(exam);
  recording.other_positions.resize(static_cast<Eigen::Index>(grid.size()), static_cast<Eigen::Index>(found.size()));
  for (std::size_t k = 0; k < found.size(); ++k) {
    std::vector<double> in_time_order;
    for (std::size_t row : exam.order) in_time_order.push_back(exam.table.columns[found[k]][row]);
    auto const known = known_values(exam, in_time_order, sampling, sampled);
    recording.other_positions.col(static_cast<Eigen::Index>(k)) =
        on_grid(known, sampling, grid, 0.0) * exam.options.position_per_unit;
    recording.other_columns.push_back(exam.table.names[found[k]]);
  }
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
  if (facts.torque_limit_share >= levels::rows_at_limit_worth_saying)
    warnings.push_back(
        {"saturation", fmt::format("torque sits at its limit {:.2g} % of the time", 100 * facts.torque_limit_share)});
  return warnings;
}

// rows that carry the position: those of another topic stand between them, with empty cells
std::vector<std::size_t> rows_of_position(Examination& exam) {
  constexpr double another_topic = 0.2;  // of the rows lack it
  std::vector<std::size_t> all(exam.rows());
  std::iota(all.begin(), all.end(), std::size_t{0});
  auto const& values = exam.table.columns[static_cast<std::size_t>(
      std::find(exam.table.names.begin(), exam.table.names.end(), exam.channels.at("position").column) -
      exam.table.names.begin())];
  std::vector<std::size_t> carrying;
  for (std::size_t row : all)
    if (std::isfinite(values[exam.order[row]])) carrying.push_back(row);
  bool const is_merged = exam.table.has_merged_clocks ||
                         static_cast<double>(carrying.size()) < (1.0 - another_topic) * static_cast<double>(all.size());
  return is_merged && exam.has("time") ? carrying : all;
}

void examine(Examination& exam) {
  exam.order.resize(exam.table.columns.front().size());
  std::iota(exam.order.begin(), exam.order.end(), std::size_t{0});
  for (auto const& remark : exam.table.remarks)
    exam.add(FindingKind::reader_remark, Grade::note, Repair::none, file_name(exam.table), {}, 0.0, remark);
  if (exam.has("time")) examine_clock(exam);
  if (exam.time_s.empty())
    for (std::size_t i = 0; i < exam.rows(); ++i) exam.time_s.push_back(static_cast<double>(i) / exam.options.rate_hz);
  if (!exam.has("position")) integrate_velocity(exam);
  examine_constant_reference(exam);
  take_out_stop_codes(exam);     // they look like a register without its sign, or sentinels
  examine_values_outside(exam);  // a register or a modulus is never told from these
  examine_units(exam);
  decode_registers(exam);
  unwrap_position(exam);
  examine_slow_sources(exam);   // what they repeat is no lost packet
  examine_repeated_rows(exam);  // or what makes up for them would be jumps
  examine_position_rows(exam);
  examine_reference(exam);
  examine_copied_reference(exam);
  examine_torque_rows(exam);
  examine_values_inside(exam, "torque");
  examine_torque_sign(exam);
  leave_out_switched_off(exam);
  close_set_clock(exam);
  examine_velocity(exam);
  find_other_joints(exam);
  find_standstill(exam);
}

Sampling sampling_of(Examination const& exam, std::vector<std::size_t> const& sampled) {
  if (!exam.has("time")) return sampling_at(exam.options.rate_hz, sampled.size());
  std::vector<double> stamps;
  stamps.reserve(sampled.size());
  for (std::size_t row : sampled) stamps.push_back(exam.time_s[row]);
  return analyse_sampling(stamps, exam.table, exam.stamp_unit_s);
}

// each stretch once, in order
std::vector<Stretch> merged(std::vector<LeftOutStretch> const& because) {
  std::vector<Stretch> stretches;
  for (auto const& one : because) stretches.push_back(one.where);
  std::sort(stretches.begin(), stretches.end(), [](auto const& a, auto const& b) { return a.from_s < b.from_s; });
  std::vector<Stretch> whole;
  for (auto const& stretch : stretches) {
    if (!whole.empty() && stretch.from_s <= whole.back().until_s)
      whole.back().until_s = std::max(whole.back().until_s, stretch.until_s);
    else
      whole.push_back(stretch);
  }
  return whole;
}

void report_left_out(Examination& exam, std::vector<Stretch> const& stretches) {
  double sum = 0.0;
  for (auto const& stretch : stretches) sum += stretch.until_s - stretch.from_s;
  if (stretches.empty()) return;
  auto& finding = exam.add(FindingKind::stretch_left_out, Grade::warning, Repair::left_out, "time", {}, sum);
  finding.count = static_cast<std::int64_t>(stretches.size());
  finding.detail = fmt::format("{:.4g} to {:.4g} s", stretches.front().from_s + exam.first_stamp_s,
                               stretches.front().until_s + exam.first_stamp_s);
}

}  // namespace

Recording make_recording(RawTable const& whole, RecordingOptions const& options, Section const& section,
                         OtherJoints others, TorqueColumn torque) {
  check_options(options, section);
  std::optional<RawTable> made;
  if (!whole.lengths.empty()) check_block_lengths(whole, options);
  if (!options.clocks.empty())
    made = on_one_clock(whole, options, section, torque);
  else if (!whole.lengths.empty())
    made = block_of(whole, pick_channels(whole, options, section, torque).begin()->second.column);
  RawTable const& table = made ? *made : whole;
  Examination exam{table, options, section, pick_channels(table, options, section, torque)};
  check_rows(table);
  auto missing_words = missing_values(exam.channels, table, options);
  check_moves(exam.channels, table);
  examine(exam);

  auto const sampled = rows_of_position(exam);
  auto const sampling = sampling_of(exam, sampled);
  auto const grid = grid_times(sampling, options.delay());
  validate(grid.size() >= fewest_rows, [&] {
    return problem_at(
        section, "delay_s",
        fmt::format("delay_s = {:g} leaves {} of {} samples", options.delay(), grid.size(), sampling.times.size()),
        "delays of joints are milliseconds: -0.004");
  });

  Recording recording;
  recording.name = file_name(table);
  recording.sha256 = table.sha256;
  recording.rate_hz = sampling.rate_hz;
  recording.time_s = Eigen::Map<Eigen::VectorXd const>(grid.data(), static_cast<Eigen::Index>(grid.size())).array() +
                     exam.first_stamp_s;
  auto& because = recording.left_out_because;
  for (auto const& gap : sampling.gaps) because.push_back({gap, LeftOutReason::no_rows});
  for (std::size_t k = 0; k < options.leave_out.size(); k += 2)
    because.push_back({{options.leave_out[k] - exam.first_stamp_s, options.leave_out[k + 1] - exam.first_stamp_s},
                       LeftOutReason::asked_for});
  auto const take = [&](char const* name, Eigen::VectorXd& out, double delay_s) {
    auto const channel = exam.channels.find(name);
    if (channel == exam.channels.end()) return;
    auto const known = known_values(exam, channel->second.values, sampling, sampled);
    auto const source = exam.source_hz.find(name);
    double const own_hz = source == exam.source_hz.end() ? sampling.rate_hz : source->second;
    std::string const channel_name = name;
    bool const tells_motion =
        channel_name == "position" || channel_name == "velocity" || channel_name == "acceleration";
    add_holes(known, grid, own_hz, delay_s, {channel->second.column, tells_motion}, because);
    out = on_grid(known, sampling, grid, delay_s) * unit_of(name, options);
  };
  take("position", recording.position, 0.0);
  recording.torque = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(grid.size()));
  take("torque", recording.torque, options.delay());
  take("reference", recording.reference, 0.0);
  take("velocity", recording.velocity, 0.0);
  take("acceleration", recording.acceleration, 0.0);
  for (auto* positions : {&recording.position, &recording.reference}) positions->array() += options.zero.front();
  take("simulated_torque", recording.simulated_torque, 0.0);
  take("simulated_position", recording.simulated_position, 0.0);
  take("added_command", recording.added_command, 0.0);
  take("external_torque", recording.external_torque, 0.0);
  // between rows the nearer one says whether the drive is on
  constexpr double half = 0.5;
  if (exam.has("enabled"))
    for (double& value : exam.values("enabled"))
      if (std::isfinite(value)) value = value != 0.0 ? 1.0 : 0.0;
  take("enabled", recording.enabled, 0.0);
  recording.enabled = (recording.enabled.array() > half).cast<double>();
  if (others == OtherJoints::kept) take_other_joints(exam, sampling, sampled, grid, recording);
  recording.left_out = merged(because);
  report_left_out(exam, recording.left_out);

  recording.rows = sampling.facts;
  recording.rows.repeated += exam.repeated;
  recording.rows.position_hz = exam.source_hz.contains("position") ? exam.source_hz.at("position") : 0.0;
  recording.rows.torque_hz = exam.source_hz.contains("torque") ? exam.source_hz.at("torque") : 0.0;
  recording.rows.resampled = count_resampled(sampling, grid);
  auto const known_of = [&](char const* name) {
    std::vector<double> values = exam.values(name);
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return values;
  };
  recording.rows.encoder_step = shown_step(known_of("position")) * std::fabs(options.position_per_unit);
  if (exam.has("torque")) recording.rows.torque_limit_share = limit_share(known_of("torque"));
  recording.warnings = std::move(missing_words);
  for (auto& warning : warnings_of(recording.rows, recording.rate_hz)) recording.warnings.push_back(std::move(warning));
  recording.lone = find_lone_rows(exam);
  recording.torque_unit = unit_of_unknown_torque(exam);
  recording.findings = std::move(exam.findings);
  return recording;
}

}  // namespace torquescope
