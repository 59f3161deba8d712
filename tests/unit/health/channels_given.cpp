// Recordings whose channels are not given as usual: a velocity in place of the position, clocks of their own.

#include <gmock/gmock.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/data/health/finding_text.hpp"
#include "engine/data/health/make_recording.hpp"
#include "engine/data/own_clocks.hpp"
#include "unit/health/sample_recording.hpp"

namespace torquescope {
namespace channels_given_test {

using health_test::Drawn;
using health_test::sample_options;
using health_test::sample_table;
using testing::HasSubstr;

Section section(std::vector<std::string> const& written = {}) {
  Section section{"recording", {}, {}};
  for (auto const& key : written) section.settings.push_back({key, OptionValue(1.0), {}, {}});
  return section;
}

Finding const* found(Recording const& recording, FindingKind kind) {
  auto const at = std::find_if(recording.findings.begin(), recording.findings.end(),
                               [&](Finding const& one) { return one.kind == kind; });
  return at == recording.findings.end() ? nullptr : &*at;
}

RecordingOptions of_velocity() {
  RecordingOptions options;
  options.columns = {{"time", "t_s"}, {"velocity", "qd_radps"}, {"torque", "tau_Nm"}};
  return options;
}

// the largest difference of two positions that may start anywhere
double largest_difference(Eigen::VectorXd const& a, Eigen::VectorXd const& b) {
  Eigen::VectorXd const difference = a - b;
  return (difference.array() - difference[0]).abs().maxCoeff();
}

TEST(SpeedAlone, IsIntegratedFromZeroAndSaysSo) {
  for (double rate_hz : {100.0, 500.0}) {
    auto const table = sample_table({.rate_hz = rate_hz});
    auto const whole = make_recording(table, sample_options(), section());
    auto const recording = make_recording(table, of_velocity(), section());
    EXPECT_EQ(recording.position[0], 0.0);
    EXPECT_EQ(recording.velocity.size(), 0);
    EXPECT_LT(largest_difference(recording.position, whole.position), 4.0 / (rate_hz * rate_hz) + 3e-5);
    auto const* finding = found(recording, FindingKind::position_integrated);
    ASSERT_NE(finding, nullptr);
    EXPECT_THAT(sentence_of(*finding), HasSubstr("start is unknown"));
  }
}

TEST(SpeedAlone, ItsUnitIsThatOfTheJob) {
  auto table = sample_table();
  auto const in_si = make_recording(table, of_velocity(), section());
  for (double& v : table.columns[3]) v *= 60.0 / 6.283185307179586;
  auto options = of_velocity();
  options.velocity_per_unit = 6.283185307179586 / 60.0;
  options.position_per_unit = 0.5;  // of no column
  auto const in_rpm = make_recording(table, options, section({"velocity_per_unit"}));
  EXPECT_LT(largest_difference(in_rpm.position, in_si.position), 1e-9);
  table.names[3] = "speed_rpm";
  options = of_velocity();
  options.columns["velocity"] = "speed_rpm";
  auto const unstated = make_recording(table, options, section());
  auto const* finding = found(unstated, FindingKind::unit_in_name);
  ASSERT_NE(finding, nullptr);
  EXPECT_THAT(cure_of(*finding), HasSubstr("velocity_per_unit = 0.1047"));
}

TEST(SpeedAlone, MissingValuesAreBridgedAndLeftOut) {
  auto table = sample_table();
  auto const whole = make_recording(table, of_velocity(), section());
  for (std::size_t k = 1000; k < 1003; ++k) table.columns[3][k] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_LT(largest_difference(make_recording(table, of_velocity(), section()).position, whole.position), 1e-3);
  for (std::size_t k = 1000; k < 1030; ++k) table.columns[3][k] = std::numeric_limits<double>::quiet_NaN();
  auto const holed = make_recording(table, of_velocity(), section());
  ASSERT_EQ(holed.left_out_because.size(), 1u);
  EXPECT_EQ(holed.left_out_because[0].column, "qd_radps");
  EXPECT_TRUE(holed.left_out_because[0].of_motion);
}

TEST(SpeedAlone, AReferenceBesideItIsRefused) {
  auto options = of_velocity();
  options.columns["reference"] = "q_rad";
  try {
    make_recording(sample_table(), options, section());
    ADD_FAILURE() << "nothing was thrown";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_job);
    EXPECT_THAT(error.problems().front().what, HasSubstr("reference without position"));
  }
}

// each channel at its own rate, the torque a little later and shorter
RawTable with_two_clocks(RawTable const& position, RawTable const& torque) {
  RawTable table{"/data/blocks.csv", "x", {"t1", "q_rad", "t2", "tau_Nm"}, {}};
  std::size_t const n = std::max(position.columns[0].size(), torque.columns[0].size());
  auto const add = [&](std::vector<double> values, double shift) {
    for (double& value : values) value += shift;
    values.resize(n, std::numeric_limits<double>::quiet_NaN());
    table.columns.push_back(std::move(values));
  };
  add(position.columns[0], 0.0);
  add(position.columns[1], 0.0);
  add(torque.columns[0], 0.0);
  add(torque.columns[2], 0.0);
  return table;
}

TEST(OwnClocksOfChannels, AreInterpolatedOnThePositionsClock) {
  auto options = sample_options();
  options.columns["time"] = "t1";
  options.clocks = {{"torque", "t2"}};
  for (double other_hz : {100.0, 250.0, 500.0, 1000.0}) {
    auto const position = sample_table({.noise = 0.0}), torque = sample_table({.rate_hz = other_hz, .noise = 0.0});
    auto const recording = make_recording(with_two_clocks(position, torque), options, section());
    auto const whole = make_recording(position, sample_options(), section());
    EXPECT_EQ(recording.rate_hz, 500.0);
    ASSERT_EQ(recording.position.size(), whole.position.size());
    EXPECT_LT((recording.position - whole.position).cwiseAbs().maxCoeff(), 1e-9);
    // the sign of the friction changes within one sample of the slower clock
    Eigen::VectorXd const difference = (recording.torque - whole.torque).cwiseAbs();
    EXPECT_LT(std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size())), 0.1) << other_hz;
    EXPECT_EQ(found(recording, FindingKind::stamps_of_arrival), nullptr);
    EXPECT_EQ(found(recording, FindingKind::rows_repeated), nullptr);
    EXPECT_TRUE(std::none_of(recording.findings.begin(), recording.findings.end(),
                             [](Finding const& one) { return one.grade == Grade::fault; }));
  }
}

}  // namespace channels_given_test
}  // namespace torquescope
