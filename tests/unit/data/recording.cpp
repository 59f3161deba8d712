// From rows to a recording: mapping, units, delay, gaps, resampling; and the words of every refusal.

#include "engine/data/recording.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "engine/base/random_stream.hpp"
#include "engine/data/health/make_recording.hpp"
#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace recording_test {

using data_test::problem_of;
using data_test::problems_of;
using data_test::recording_section;
using testing::HasSubstr;

double const nan = std::numeric_limits<double>::quiet_NaN();

double position_at(double t) { return 0.8 * std::sin(3 * t); }
double torque_at(double t) { return 2 * std::cos(5 * t) + 0.1; }

// t_s, q_rad, i_A, qd_radps, mode at the given times; the header stands in line 1
RawTable table_at(std::vector<double> const& times) {
  RawTable table;
  table.path = "/data/arm.csv";
  table.sha256 = "abc";
  table.names = {"t_s", "q_rad", "i_A", "qd_radps", "sim_Nm"};
  table.columns.resize(5);
  for (std::size_t i = 0; i < times.size(); ++i) {
    double const t = times[i];
    table.columns[0].push_back(t);
    table.columns[1].push_back(position_at(t));
    table.columns[2].push_back(torque_at(t));
    table.columns[3].push_back(2.4 * std::cos(3 * t));
    table.columns[4].push_back(std::sin(t) + 2);
    table.line_of_row.push_back(static_cast<std::int64_t>(i) + 2);
  }
  table.unusable.push_back({"mode", "holds text: \"run\" in line 2", 2});
  return table;
}

std::vector<double> even_times(std::size_t n = 2000, double rate_hz = 1000) {
  std::vector<double> times;
  for (std::size_t i = 0; i < n; ++i) times.push_back(static_cast<double>(i) / rate_hz);
  return times;
}

RecordingOptions options_of(std::map<std::string, std::string> columns = {
                                {"time", "t_s"}, {"position", "q_rad"}, {"torque", "i_A"}}) {
  RecordingOptions options;
  options.columns = std::move(columns);
  return options;
}

Recording made(RawTable const& table, RecordingOptions const& options) {
  return make_recording(table, options, recording_section());
}
Problem refused(RawTable const& table, RecordingOptions const& options) {
  return problem_of([&] { made(table, options); });
}

double largest_error(Eigen::VectorXd const& times, Eigen::VectorXd const& values, double (*truth)(double)) {
  double worst = 0;
  for (Eigen::Index i = 0; i < times.size(); ++i) worst = std::max(worst, std::fabs(values[i] - truth(times[i])));
  return worst;
}

TEST(MakeRecording, EvenRowsAreTakenBitForBit) {
  auto const table = table_at(even_times());
  auto const recording = made(table, options_of());
  EXPECT_EQ(recording.name, "arm.csv");
  EXPECT_EQ(recording.sha256, "abc");
  EXPECT_EQ(recording.rate_hz, 1000);
  ASSERT_EQ(recording.position.size(), 2000);
  for (Eigen::Index i = 0; i < 2000; ++i)
    ASSERT_EQ(recording.position[i], table.columns[1][static_cast<std::size_t>(i)]);
  EXPECT_EQ(recording.velocity.size(), 0);
  EXPECT_TRUE(recording.warnings.empty());
  EXPECT_EQ(recording.rows.resampled, 0);
}

TEST(MakeRecording, UnitsScaleTheirOwnChannelsOnly) {
  auto options = options_of({{"time", "t_s"}, {"position", "q_rad"}, {"torque", "i_A"}, {"velocity", "qd_radps"}});
  options.torque_per_unit = {10};
  options.position_per_unit = 0.5;
  options.simulated_torque = "sim_Nm";
  auto const table = table_at(even_times());
  auto const recording = made(table, options);
  EXPECT_EQ(recording.torque[7], 10 * table.columns[2][7]);
  EXPECT_EQ(recording.position[7], 0.5 * table.columns[1][7]);
  EXPECT_EQ(recording.velocity[7], 0.5 * table.columns[3][7]);
  EXPECT_EQ(recording.simulated_torque[7], table.columns[4][7]);
}

double simulated_at(double t) { return std::sin(t) + 2; }

// the simulator was given the recorded motion: its torque has the motion's stamps, whatever the torque channel's delay
TEST(MakeRecording, SimulatedTorqueStaysWithTheMotion) {
  auto options = options_of();
  options.simulated_torque = "sim_Nm";
  options.delay_s = {-0.0038};
  auto const late = made(table_at(even_times()), options);
  EXPECT_EQ(late.simulated_torque.size(), late.torque.size());
  EXPECT_LT(largest_error(late.time_s, late.simulated_torque, simulated_at), 1e-12);

  options.delay_s = {0};
  auto jittered = even_times();
  for (std::size_t i = 0; i < jittered.size(); i += 3) jittered[i] += 2e-4;
  auto const resampled = made(table_at(jittered), options);
  EXPECT_GT(resampled.rows.resampled, 0);
  EXPECT_LT(largest_error(resampled.time_s, resampled.simulated_torque, simulated_at), 1e-8);
}

TEST(MakeRecording, SimulatedTorqueThatIsNotThereIsRefusedByItsOwnKey) {
  auto options = options_of();
  options.simulated_torque = "sim_nm";
  auto const problem = refused(table_at(even_times()), options);
  EXPECT_EQ(problem.code, ExitCode::bad_job);
  EXPECT_EQ(problem.key, "recording.simulated_torque");
  EXPECT_THAT(problem.what, HasSubstr("no column \"sim_nm\" in arm.csv"));
  EXPECT_THAT(problem.caret_note, HasSubstr("sim_Nm"));
}

TEST(MakeRecording, RateServesWhereThereIsNoTime) {
  auto options = options_of({{"position", "q_rad"}, {"torque", "i_A"}});
  options.rate_hz = 500;
  auto const recording = made(table_at(even_times()), options);
  EXPECT_EQ(recording.rate_hz, 500);
  EXPECT_EQ(recording.time_s[100], 0.2);
}

// a torque stamped 3.8 ms late is put right by delay_s = -0.0038, between the samples too
TEST(MakeRecording, DelayMovesTheTorqueAgainstTheMotion) {
  for (double late : {0.0038, 0.004, -0.0021}) {
    auto table = table_at(even_times());
    for (std::size_t i = 0; i < 2000; ++i) table.columns[2][i] = torque_at(table.columns[0][i] - late);
    auto options = options_of();
    options.delay_s = {-late};
    auto const recording = made(table, options);
    EXPECT_EQ(recording.position.size(), recording.torque.size());
    EXPECT_EQ(recording.position.size(), 2000 - static_cast<Eigen::Index>(std::ceil(std::fabs(late) * 1000 - 1e-9)));
    EXPECT_LT(largest_error(recording.time_s, recording.torque, torque_at), 1e-8);
    EXPECT_LT(largest_error(recording.time_s, recording.position, position_at), 1e-15);
  }
}

TEST(MakeRecording, JitteredRowsAreResampledOntoAnEvenGridAndReported) {
  RandomStream stream({24, 0, RandomDomain::test}, 0, 0);
  auto times = even_times(3000, 200);
  for (double& t : times) t += 0.1 / 200 * stream.uniform(-1, 1);
  times.erase(times.begin() + 500, times.begin() + 503);
  times.insert(times.begin() + 900, times[900]);
  auto const recording = made(table_at(times), options_of());
  EXPECT_EQ(recording.rate_hz, 200);
  EXPECT_NEAR(recording.time_s[1000] - recording.time_s[999], 0.005, 1e-12);
  EXPECT_LT(largest_error(recording.time_s, recording.position, position_at), 2e-6);
  EXPECT_LT(largest_error(recording.time_s, recording.torque, torque_at), 2e-5);
  EXPECT_EQ(recording.rows.repeated, 1);
  EXPECT_EQ(recording.rows.missing, 3);
  EXPECT_GT(recording.rows.resampled, 2000);
  ASSERT_EQ(recording.warnings.size(), 1u);
  EXPECT_EQ(recording.warnings[0].topic, "jitter");
  EXPECT_THAT(recording.warnings[0].text, HasSubstr(", put on an even grid of 200 Hz"));
  EXPECT_THAT(recording.warnings[0].text, HasSubstr("1 repeated time stamp, 3 missing"));
}

TEST(MakeRecording, DriveIsOnOrOffAsTheNearestRowSays) {
  auto times = even_times(2000);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] += 2e-4 * std::sin(1.7 * static_cast<double>(i));
  auto const is_on = [](double row) { return std::fmod(row, 100.0) < 50.0; };
  auto table = table_at(times);
  table.names.push_back("state");
  table.columns.emplace_back();
  for (std::size_t i = 0; i < times.size(); ++i)
    table.columns.back().push_back(is_on(static_cast<double>(i)) ? 5.0 : 0.0);
  auto options = options_of();
  options.columns["enabled"] = "state";
  auto const recording = made(table, options);
  for (Eigen::Index i = 1; i + 1 < recording.enabled.size(); ++i) {
    double const row = recording.time_s[i] * 1000, half_way = std::fmod(row + 0.5, 50.0);
    if (std::min(half_way, 50.0 - half_way) < 0.4) continue;  // either row may be the nearer one
    ASSERT_EQ(recording.enabled[i], is_on(row + 0.5) ? 1.0 : 0.0) << row;
  }
}

TEST(MakeRecording, TorqueMayBeMissingWhereItIsOptional) {
  auto const table = table_at(even_times());
  auto const options = options_of({{"time", "t_s"}, {"position", "q_rad"}});
  EXPECT_EQ(refused(table, options).what, "columns names no torque");
  auto const recording =
      make_recording(table, options, recording_section(), OtherJoints::ignored, TorqueColumn::optional);
  EXPECT_EQ(recording.torque, Eigen::VectorXd::Zero(2000));
  EXPECT_EQ(recording.position, made(table, options_of()).position);
}

TEST(MakeRecording, WithoutColumnsItSaysWhatToWriteAndGuessesNothing) {
  auto const problem = refused(table_at(even_times()), options_of({}));
  EXPECT_EQ(problem.code, ExitCode::bad_job);
  EXPECT_EQ(problem.what, "recording.columns does not say which columns of arm.csv are position and torque");
  EXPECT_EQ(problem.notes, std::vector<std::string>{"the file has: t_s, q_rad, i_A, qd_radps, sim_Nm"});
  EXPECT_EQ(problem.help, "columns = {time = \"t_s\", position = \"q_rad\", torque = \"i_A\"}");
  EXPECT_EQ(problem.place.line, 8);
}

TEST(MakeRecording, MissingColumnListsTheFilesColumnsAndTheWayOut) {
  auto const table = table_at(even_times());
  auto const problem = refused(table, options_of({{"time", "t_s"}, {"position", "q_rad"}, {"torque", "tau"}}));
  EXPECT_EQ(problem.code, ExitCode::bad_job);
  EXPECT_EQ(problem.what, "no column \"tau\" in arm.csv");
  EXPECT_EQ(problem.notes, std::vector<std::string>{"the file has: t_s, q_rad, i_A, qd_radps, sim_Nm"});
  EXPECT_EQ(problem.help, "torque = \"i_A\" with torque_per_unit = <N m per A>");
  EXPECT_EQ(problem.key, "recording.columns.torque");
  EXPECT_EQ(problem.place.file, "job.toml");

  auto const slip = refused(table, options_of({{"time", "t_s"}, {"position", "q_rda"}, {"torque", "i_A"}}));
  EXPECT_EQ(slip.caret_note, "did you mean \"q_rad\"?");
}

TEST(MakeRecording, AllProblemsOfTheMappingAreToldAtOnce) {
  auto const problems = problems_of([] {
    made(table_at(even_times()), options_of({{"positon", "q_rad"}, {"torque", "i_A"}, {"acceleration", "qdd"}}));
  });
  std::vector<std::string> what;
  for (auto const& problem : problems) what.push_back(problem.what);
  EXPECT_THAT(what, testing::UnorderedElementsAre("unknown channel \"positon\"", "columns names no position",
                                                  "columns names no time, and there is no rate_hz",
                                                  "acceleration without velocity", "no column \"qdd\" in arm.csv"));
  EXPECT_EQ(problems[0].caret_note + problems[1].caret_note, "did you mean \"position\"?");
}

TEST(MakeRecording, ContradictingMappingsAreRefused) {
  auto table = table_at(even_times());
  EXPECT_EQ(refused(table, options_of({{"time", "t_s"}, {"position", "q_rad"}, {"torque", "q_rad"}})).what,
            "position and torque are both \"q_rad\"");
  auto with_rate = options_of();
  with_rate.rate_hz = 1000;
  EXPECT_EQ(refused(table, with_rate).what, "rate_hz = 1000 beside a time column");
  auto const text = refused(table, options_of({{"time", "t_s"}, {"position", "mode"}, {"torque", "i_A"}}));
  EXPECT_EQ(text.code, ExitCode::bad_data);
  EXPECT_EQ(text.what, "column \"mode\" of arm.csv holds text: \"run\" in line 2");
  EXPECT_EQ(text.place.line, 2);
  table.names[3] = "q_rad";
  EXPECT_EQ(refused(table, options_of()).what, "arm.csv has 2 columns called \"q_rad\"");
  auto no_unit = options_of();
  no_unit.torque_per_unit = {0};
  EXPECT_EQ(refused(table, no_unit).what, "torque_per_unit = 0 would erase the signal");
}

TEST(MakeRecording, LastPartOfAPathServesWhenItIsUnique) {
  auto table = table_at(even_times());
  table.names = {"clock/t", "left/q", "left/tau", "right/q", "right/tau"};
  EXPECT_EQ(made(table, options_of({{"time", "t"}, {"position", "left/q"}, {"torque", "right/tau"}})).rate_hz, 1000);
  auto const both = refused(table, options_of({{"time", "t"}, {"position", "q"}, {"torque", "right/tau"}}));
  EXPECT_EQ(both.what, "arm.csv has 2 columns called \"q\"");
  EXPECT_EQ(both.help, "write the whole path: left/q");
}

TEST(MakeRecording, MissingValuesAreRefusedWhereTheJobAsksForIt) {
  auto table = table_at(even_times());
  for (std::size_t i = 410; i < 427; ++i) table.columns[1][i] = nan;
  auto options = options_of();
  options.gaps = "error";
  auto const problem = refused(table, options);
  EXPECT_EQ(problem.code, ExitCode::bad_data);
  EXPECT_EQ(problem.what, "17 values of \"q_rad\" are not numbers, first in line 412");
  EXPECT_EQ(problem.place.file, "/data/arm.csv");
  EXPECT_EQ(problem.place.line, 412);
  EXPECT_EQ(problem.notes, std::vector<std::string>{"t = 0.410 s"});
  EXPECT_THAT(problem.help, HasSubstr("recording.gaps = \"fill\""));
}

TEST(MakeRecording, ShortGapsAreFilledOverTime) {
  auto table = table_at(even_times());
  for (std::size_t i = 410; i < 415; ++i) table.columns[1][i] = nan;
  table.columns[1][800] = nan;
  auto const recording = made(table, options_of());
  EXPECT_TRUE(recording.left_out.empty());
  EXPECT_LT(largest_error(recording.time_s, recording.position, position_at), 1e-6);
  ASSERT_EQ(recording.warnings.size(), 1u);
  EXPECT_EQ(recording.warnings[0].text, "6 missing values of \"q_rad\" in 2 places, first in line 412");
}

TEST(MakeRecording, LongGapsAreLeftOut) {
  auto table = table_at(even_times());
  for (std::size_t i = 410; i < 450; ++i) table.columns[1][i] = nan;
  for (std::size_t i = 1990; i < 2000; ++i) table.columns[2][i] = nan;
  auto const recording = made(table, options_of());
  EXPECT_EQ(recording.position.size(), 2000);
  ASSERT_EQ(recording.left_out.size(), 2u);
  EXPECT_NEAR(recording.left_out[0].from_s, 0.409, 1e-9);
  EXPECT_NEAR(recording.left_out[0].until_s, 0.450, 1e-9);
  EXPECT_NEAR(recording.left_out[1].from_s, 1.989, 1e-9);
}

TEST(MakeRecording, UnusedColumnsMayHoldAnything) {
  auto table = table_at(even_times());
  table.columns[4].assign(2000, nan);
  EXPECT_NO_THROW(made(table, options_of()));
}

TEST(MakeRecording, StillSignalsAndStumpsAreRefused) {
  auto table = table_at(even_times());
  table.columns[2].assign(2000, 0.25);
  auto const constant = refused(table, options_of());
  EXPECT_EQ(constant.code, ExitCode::bad_data);
  EXPECT_EQ(constant.what, "\"i_A\" never changes: torque is 0.25 in every row");
  EXPECT_EQ(constant.help, "name the right column, or record a motion");
  EXPECT_EQ(refused(table_at(even_times(5)), options_of()).what, "arm.csv has 5 samples; at least 16 are needed");
  auto far = options_of();
  far.delay_s = {-1.995};
  EXPECT_EQ(refused(table_at(even_times()), far).what, "delay_s = -1.995 leaves 5 of 2000 samples");
}

TEST(MakeRecording, TimeThatStartsAnewIsRefused) {
  auto table = table_at(even_times());
  for (std::size_t i = 809; i < 2000; ++i) table.columns[0][i] -= 0.808;
  EXPECT_EQ(refused(table, options_of()).what, "time starts anew in line 811 (0.808 -> 0.001 s)");
}

TEST(MakeRecording, SaturationIsCountedOnTheRows) {
  auto table = table_at(even_times());
  std::size_t clipped = 0;
  for (double& torque : table.columns[2]) {
    clipped += torque >= 1.9;
    torque = std::min(torque, 1.9);
  }
  auto const recording = made(table, options_of());
  EXPECT_NEAR(recording.rows.torque_limit_share, static_cast<double>(clipped) / 2000, 1e-12);
  ASSERT_EQ(recording.warnings.size(), 1u);
  EXPECT_EQ(recording.warnings[0].topic, "saturation");
  EXPECT_THAT(recording.warnings[0].text, HasSubstr("torque sits at its limit"));
}

}  // namespace recording_test
}  // namespace torquescope
