// Every kind of fault that the examination knows, put into drawn recordings of several rates and sizes: it is found, at
// its rows, and what can be mended is as it was.

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "engine/base/error.hpp"
#include "engine/data/health/finding_text.hpp"
#include "engine/data/health/make_recording.hpp"
#include "unit/health/sample_recording.hpp"

namespace torquescope {
namespace recording_faults_test {

using health_test::Drawn;
using health_test::sample_options;
using health_test::sample_table;
using testing::HasSubstr;

constexpr double turn = 2.0 * std::numbers::pi;

Section job_section(std::vector<std::string> const& written = {}) {
  Section section{"recording", {}, {}};
  for (auto const& key : written) section.settings.push_back({key, OptionValue(1.0), {}, {}});
  return section;
}

Finding const* found(Recording const& recording, FindingKind kind) {
  auto const at = std::find_if(recording.findings.begin(), recording.findings.end(),
                               [&](Finding const& one) { return one.kind == kind; });
  return at == recording.findings.end() ? nullptr : &*at;
}

double largest_difference(Eigen::VectorXd const& a, std::vector<double> const& b) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::fabs(a[i] - b[static_cast<std::size_t>(i)]));
  return largest;
}

std::vector<Drawn> draws() {
  return {{500, 12, 0.9, 2e-5, 0.02, 1},
          {1000, 8, 0.3, 1e-4, 0.05, 2},
          {200, 20, 1.5, 0.0, 0.01, 3},
          {100, 30, 0.9, 1.5e-3, 0.02, 4}};
}

TEST(PositionExamination, UnwrapsTurnsAndCounters) {
  for (auto drawn : draws()) {
    drawn.encoder_step = 0.0;  // the counter's is enough
    auto const sound = sample_table(drawn);
    for (double modulus : {turn, 360.0, 65536.0, 4096.0}) {
      auto table = sound;
      auto options = sample_options();
      options.position_per_unit = turn / modulus;
      for (double& q : table.columns[1]) {
        double const turns = 3.0 * q / turn;  // several times round
        q = modulus * (turns - std::floor(turns));
        if (modulus > 1000) q = std::floor(q);
      }
      auto const recording = make_recording(table, options, job_section({"position_per_unit"}));
      auto const* finding = found(recording, FindingKind::position_wraps);
      ASSERT_NE(finding, nullptr) << modulus << " at " << drawn.rate_hz;
      EXPECT_NEAR(finding->size, modulus, 1e-6 * modulus);
      double const start = recording.position[0] - 3.0 * sound.columns[1][0];
      double worst = 0.0;
      for (Eigen::Index i = 0; i < recording.position.size(); ++i)
        worst = std::max(
            worst, std::fabs(recording.position[i] - start - 3.0 * sound.columns[1][static_cast<std::size_t>(i)]));
      EXPECT_LT(worst, 2.1 * turn / std::min(modulus, 65536.0) + 1e-9) << modulus;
    }
  }
}

TEST(PositionExamination, FillsSingleWrongRowsAndNamesTheirLines) {
  for (auto const& drawn : draws()) {
    auto const sound = sample_table(drawn);
    auto table = sound;
    std::vector<std::int64_t> lines;
    for (std::size_t row : {301u, 700u, 1203u}) {
      if (std::fabs(table.columns[1][row]) < 0.1 * drawn.amplitude) row += 40;
      table.columns[1][row] = 0.0;
      lines.push_back(static_cast<std::int64_t>(row) + 2);
    }
    auto const recording = make_recording(table, sample_options(), job_section());
    auto const* finding = found(recording, FindingKind::single_wrong_rows);
    ASSERT_NE(finding, nullptr) << drawn.rate_hz;
    EXPECT_EQ(finding->lines, lines);
    EXPECT_EQ(finding->repair, Repair::filled);
    EXPECT_LT(largest_difference(recording.position, sound.columns[1]), 2e-3 + 2 * drawn.encoder_step);
  }
}

TEST(PositionExamination, JumpsAreFaultsAtTheirLine) {
  for (auto const& drawn : draws()) {
    auto table = sample_table(drawn);
    for (std::size_t row = 900; row < table.columns[1].size(); ++row) table.columns[1][row] += 0.35;
    auto const recording = make_recording(table, sample_options(), job_section());
    auto const* finding = found(recording, FindingKind::position_jumps);
    ASSERT_NE(finding, nullptr) << drawn.rate_hz;
    EXPECT_TRUE(is_fault(*finding));
    EXPECT_THAT(finding->lines, testing::Contains(902));
    EXPECT_THAT(cure_of(*finding), HasSubstr("902"));
  }
}

TEST(PositionExamination, RepeatedRowsAreMissingOnes) {
  for (unsigned seed : {5u, 6u, 7u}) {
    auto const sound = sample_table({500, 12, 0.9, 2e-5, 0.02, seed});
    auto table = sound;
    std::mt19937 engine(seed);
    std::size_t stale = 0;
    for (std::size_t row = 10; row + 12 < table.columns[1].size(); row += 60 + engine() % 100) {
      std::size_t const length = 1 + engine() % 4;
      for (std::size_t k = row; k < row + length; ++k)
        for (int c : {1, 2})
          table.columns[static_cast<std::size_t>(c)][k] = table.columns[static_cast<std::size_t>(c)][row - 1];
      stale += length;
    }
    auto const recording = make_recording(table, sample_options(), job_section());
    auto const* finding = found(recording, FindingKind::rows_repeated);
    ASSERT_NE(finding, nullptr);
    EXPECT_GT(finding->count, static_cast<std::int64_t>(stale * 6 / 10));
    EXPECT_LE(finding->count, static_cast<std::int64_t>(stale));
    EXPECT_LT(largest_difference(recording.position, sound.columns[1]),
              0.3 * largest_difference(recording.position, table.columns[1]));
  }
}

TEST(PositionExamination, TwoPublishersAreAFault) {
  auto table = sample_table();
  for (std::size_t row = 0; row < table.columns[1].size(); row += 2)
    table.columns[1][row] = table.columns[2][row] = 0.0;
  auto const recording = make_recording(table, sample_options(), job_section());
  ASSERT_NE(found(recording, FindingKind::rows_interleaved), nullptr);
  EXPECT_TRUE(is_fault(*found(recording, FindingKind::rows_interleaved)));
}

TEST(TorqueExamination, SpikesAreFilledAndTheirLinesSaid) {
  for (auto const& drawn : draws()) {
    auto table = sample_table(drawn);
    table.columns[2][400] = 655.0;
    table.columns[2][1100] = -655.0;
    auto const recording = make_recording(table, sample_options(), job_section());
    auto const* finding = found(recording, FindingKind::torque_spikes);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->lines, (std::vector<std::int64_t>{402, 1102}));
    EXPECT_LT(recording.torque.cwiseAbs().maxCoeff(), 20.0);
  }
}

TEST(TorqueExamination, RegistersWithoutSignAreDecoded) {
  for (auto const& drawn : draws()) {
    auto const sound = sample_table(drawn);
    for (int bits : {12, 16}) {
      for (bool const is_sign : {false, true}) {
        auto table = sound;
        auto options = sample_options();
        double const unit = 8.0 / std::ldexp(1.0, bits - 1);
        options.torque_per_unit = {unit};
        for (double& torque : table.columns[2]) {
          double const counts = std::round(torque / unit);
          double const sign_bit = std::ldexp(1.0, bits - 1);
          torque = counts >= 0.0 ? counts : is_sign ? sign_bit - counts : counts + 2.0 * sign_bit;
        }
        auto const recording = make_recording(table, options, job_section({"torque_per_unit"}));
        auto const kind = is_sign ? FindingKind::sign_magnitude : FindingKind::unsigned_register;
        ASSERT_NE(found(recording, kind), nullptr) << bits << is_sign << " at " << drawn.rate_hz;
        EXPECT_LT(largest_difference(recording.torque, sound.columns[2]), unit);
      }
    }
  }
}

TEST(TorqueExamination, AMagnitudeHasLostItsSign) {
  for (auto const& drawn : draws()) {
    auto table = sample_table(drawn);
    for (double& torque : table.columns[2]) torque = std::fabs(torque);
    auto const recording = make_recording(table, sample_options(), job_section());
    ASSERT_NE(found(recording, FindingKind::torque_without_sign), nullptr) << drawn.rate_hz;
    EXPECT_TRUE(is_fault(*found(recording, FindingKind::torque_without_sign)));
  }
}

TEST(TorqueExamination, StretchesSwitchedOffAreLeftOut) {
  auto table = sample_table();
  for (std::size_t row = 2000; row < 3000; ++row) table.columns[2][row] = 0.0;
  auto const recording = make_recording(table, sample_options(), job_section());
  ASSERT_NE(found(recording, FindingKind::torque_switched_off), nullptr);
  EXPECT_NEAR(found(recording, FindingKind::torque_switched_off)->size, 2.0, 0.01);
  ASSERT_EQ(recording.left_out.size(), 1u);
  EXPECT_NEAR(recording.left_out[0].from_s, 3.998, 0.003);
  EXPECT_NEAR(recording.left_out[0].until_s, 6.0, 0.003);
}

TEST(ClockExamination, UnitsComeFromTheNameOrTheSizeOfTheStamps) {
  struct Stamps {
    std::string name;
    double per_second, first;
  };
  for (auto const& stamps : {Stamps{"t_ms", 1e3, 0.0}, Stamps{"time [us]", 1e6, 5e6}, Stamps{"stamp", 1e9, 1.7e18},
                             Stamps{"stamp", 1e3, 1.7e12}, Stamps{"stamp", 1.0, 1.7e9}}) {
    auto table = sample_table();
    auto options = sample_options();
    table.names[0] = options.columns["time"] = stamps.name;
    for (double& t : table.columns[0]) t = stamps.first + std::round(t * 1e6) / 1e6 * stamps.per_second;
    auto const recording = make_recording(table, options, job_section());
    EXPECT_NEAR(recording.rate_hz, 500.0, 0.5) << stamps.name << stamps.first;
    EXPECT_EQ(found(recording, FindingKind::time_unit) != nullptr, stamps.per_second > 1.0);
  }
}

TEST(ClockExamination, AnUnknownUnitIsAskedFor) {
  for (double per_second : {1e3, 1e6}) {
    auto table = sample_table();
    auto options = sample_options();
    table.names[0] = options.columns["time"] = "t";
    for (double& t : table.columns[0]) t *= per_second;
    try {
      make_recording(table, options, job_section());
      ADD_FAILURE() << "not refused";
    } catch (Error const& error) {
      EXPECT_THAT(error.problems().front().help, HasSubstr("time_per_unit"));
    }
    options.time_per_unit = 1.0 / per_second;
    EXPECT_NEAR(make_recording(table, options, job_section({"time_per_unit"})).rate_hz, 500.0, 0.5);
  }
}

TEST(ClockExamination, RowsOutOfOrderAreSorted) {
  auto const sound = sample_table();
  auto table = sound;
  std::mt19937 engine(3);
  for (int k = 0; k < 60; ++k) {
    std::size_t const row = 5 + engine() % (table.columns[0].size() - 10);
    std::size_t const other = row + 1 + engine() % 3;
    for (auto& column : table.columns) std::swap(column[row], column[other]);
  }
  auto const recording = make_recording(table, sample_options(), job_section());
  ASSERT_NE(found(recording, FindingKind::rows_out_of_order), nullptr);
  EXPECT_LT(largest_difference(recording.position, sound.columns[1]), 1e-12);
  EXPECT_LT(largest_difference(recording.torque, sound.columns[2]), 1e-12);
}

TEST(ClockExamination, CountersThatRollOverGoOn) {
  for (double modulus : {0x1p32 * 1e-6, 0x1p16 * 1e-3, 60.0}) {
    auto const sound = sample_table({500, 80, 0.9, 2e-5, 0.02, 1});
    auto table = sound;
    for (double& t : table.columns[0]) t = std::fmod(t + modulus - 10.001, modulus);
    auto const recording = make_recording(table, sample_options(), job_section());
    ASSERT_NE(found(recording, FindingKind::clock_rolls_over), nullptr) << modulus;
    EXPECT_NEAR(recording.rate_hz, 500.0, 0.1);
    EXPECT_EQ(recording.position.size(), static_cast<Eigen::Index>(sound.columns[1].size()));
  }
}

TEST(ClockExamination, BurstsAreSpreadEvenly) {
  for (std::size_t in_one : {4u, 8u, 20u}) {
    for (double apart_s : {0.0, 4e-5}) {
      auto const sound = sample_table();
      auto table = sound;
      for (std::size_t i = 0; i < table.columns[0].size(); ++i)
        table.columns[0][i] =
            static_cast<double>((i / in_one + 1) * in_one) / 500.0 + apart_s * static_cast<double>(i % in_one);
      auto const recording = make_recording(table, sample_options(), job_section());
      ASSERT_NE(found(recording, FindingKind::stamps_of_arrival), nullptr) << in_one << ' ' << apart_s;
      EXPECT_NEAR(recording.rate_hz, 500.0, 0.5);
      EXPECT_LT(largest_difference(recording.position, sound.columns[1]), 0.02);
    }
  }
}

TEST(ClockExamination, AClockThatWasSetLosesNoRows) {
  auto const sound = sample_table();
  auto table = sound;
  std::size_t row = 2500;
  while (std::fabs(sound.columns[3][row]) < 1.0) ++row;
  for (std::size_t i = row; i < table.columns[0].size(); ++i) table.columns[0][i] += 2.4;
  auto const recording = make_recording(table, sample_options(), job_section());
  ASSERT_NE(found(recording, FindingKind::clock_was_set), nullptr);
  EXPECT_NEAR(found(recording, FindingKind::clock_was_set)->size, 2.4, 0.01);
  EXPECT_LT(largest_difference(recording.position, sound.columns[1]), 1e-3);
}

TEST(VelocityExamination, ContradictingChannelsAreNotUsed) {
  struct Wrong {
    FindingKind kind;
    double (*of)(std::vector<double> const&, std::size_t);
  };
  for (auto const& drawn : draws()) {
    for (auto const &wrong :
         {Wrong{FindingKind::velocity_contradicts, [](auto const&v, std::size_t i) { return std::fabs(v[i]); }},
          Wrong{FindingKind::velocity_factor, [](auto const&v, std::size_t i) { return v[i] * 60.0 / turn; }},
          Wrong{FindingKind::velocity_factor, [](auto const&v, std::size_t i) { return -v[i]; }},
          Wrong{FindingKind::velocity_late, [](auto const&v, std::size_t i) { return v[i < 12 ? 0 : i - 12]; }},
          Wrong{FindingKind::velocity_constant, [](auto const&, std::size_t) { return 0.5; }}}) {
      auto const sound = sample_table(drawn);
      auto table = sound;
      for (std::size_t i = 0; i < table.columns[3].size(); ++i) table.columns[3][i] = wrong.of(sound.columns[3], i);
      auto const recording = make_recording(table, sample_options(true), job_section());
      ASSERT_NE(found(recording, wrong.kind), nullptr) << code_of(wrong.kind) << " at " << drawn.rate_hz;
      EXPECT_EQ(recording.velocity.size(), 0);
    }
  }
}

RawTable with_reference(RawTable table, std::vector<double> reference) {
  table.names.push_back("q_ref_rad");
  table.columns.push_back(std::move(reference));
  return table;
}

RecordingOptions options_with_reference() {
  auto options = sample_options();
  options.columns["reference"] = "q_ref_rad";
  return options;
}

// the position `rows` later, as data sets for imitation write it: with as many digits as single precision has
std::vector<double> next_state(std::vector<double> const& position, std::ptrdiff_t rows) {
  std::vector<double> later;
  auto const last = static_cast<std::ptrdiff_t>(position.size()) - 1;
  for (std::ptrdiff_t i = 0; i <= last; ++i)
    later.push_back(
        static_cast<float>(position[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i + rows, 0, last))]));
  return later;
}

TEST(ReferenceExamination, ThePositionOfAnotherRowIsNoCommand) {
  for (auto const& drawn : draws())
    for (std::ptrdiff_t rows : {1, 2, 5, -1}) {
      auto const sound = sample_table(drawn);
      auto const recording = make_recording(with_reference(sound, next_state(sound.columns[1], rows)),
                                            options_with_reference(), job_section());
      auto const* finding = found(recording, FindingKind::reference_is_position);
      ASSERT_NE(finding, nullptr) << rows << " at " << drawn.rate_hz;
      EXPECT_EQ(finding->size, static_cast<double>(rows));
      EXPECT_EQ(recording.reference.size(), 0);
    }
}

// a command that the joint follows 1.6 rows late, but for a thousandth of its range
TEST(ReferenceExamination, ACommandThatIsFollowedWellStays) {
  for (auto const& drawn : draws()) {
    auto const sound = sample_table(drawn);
    std::vector<double> reference;
    auto const& q = sound.columns[1];
    for (std::size_t i = 0; i < q.size(); ++i) {
      std::size_t const one = std::min(i + 1, q.size() - 1), two = std::min(i + 2, q.size() - 1);
      reference.push_back(0.4 * q[one] + 0.6 * q[two] + 1e-3 * drawn.amplitude * sound.columns[2][i]);
    }
    auto const recording = make_recording(with_reference(sound, reference), options_with_reference(), job_section());
    EXPECT_EQ(found(recording, FindingKind::reference_is_position), nullptr);
    EXPECT_EQ(recording.reference.size(), recording.position.size());
  }
}

TEST(ReferenceExamination, AConstantIsNoCommandUnlessTheJointComesToRest) {
  auto const sound = sample_table();
  for (double const value : {2.146e9, -32768.0, 0.0}) {
    std::vector<double> const constant(sound.columns[0].size(), value);
    auto const recording = make_recording(with_reference(sound, constant), options_with_reference(), job_section());
    auto const* finding = found(recording, FindingKind::reference_constant);
    ASSERT_NE(finding, nullptr) << value;
    EXPECT_EQ(finding->size, value);
    EXPECT_EQ(found(recording, FindingKind::sign_magnitude), nullptr);
    EXPECT_EQ(recording.reference.size(), 0);
  }
  // a step: it comes to rest where it was sent
  auto step = sound;
  for (std::size_t i = 0; i < step.columns[1].size(); ++i) {
    double const t = step.columns[0][i];
    step.columns[1][i] = 2e-5 * std::round((1.0 - std::exp(-t) * std::cos(4.0 * t)) / 2e-5);
  }
  auto const recording = make_recording(with_reference(step, std::vector<double>(step.columns[0].size(), 1.0)),
                                        options_with_reference(), job_section());
  EXPECT_EQ(found(recording, FindingKind::reference_constant), nullptr);
  EXPECT_EQ(recording.reference.size(), recording.position.size());
}

TEST(UnitExamination, NamesThatSayAnotherUnitAskForTheFactor) {
  auto table = sample_table();
  auto options = sample_options();
  table.names[1] = options.columns["position"] = "q_deg";
  auto const finding_of = [](Recording const& recording) { return found(recording, FindingKind::unit_in_name); };
  auto const asked = make_recording(table, options, job_section());
  ASSERT_NE(finding_of(asked), nullptr);
  EXPECT_THAT(cure_of(*finding_of(asked)), HasSubstr("position_per_unit = 0.01745329252"));
  EXPECT_EQ(finding_of(make_recording(table, options, job_section({"position_per_unit"}))), nullptr);

  auto permille = sample_table();
  auto with_torque = sample_options();
  permille.names[2] = with_torque.columns["torque"] = "torque_permille";
  auto const recording = make_recording(permille, with_torque, job_section());
  ASSERT_NE(found(recording, FindingKind::unit_of_current), nullptr);
  EXPECT_TRUE(is_fault(*found(recording, FindingKind::unit_of_current)));
}

// a soft position loop under a weight: the joint goes a tenth of the way that it is sent
TEST(ReferenceExamination, AJointThatDoesNotFollowTellsNoUnit) {
  auto table = sample_table();
  auto options = sample_options();
  auto const& position = table.columns[1];
  std::size_t const lag = position.size() / 20;
  std::vector<double> reference(position.size());
  for (std::size_t i = 0; i < reference.size(); ++i)
    reference[i] = 10.0 * position[std::min(i + lag, position.size() - 1)];
  table.names.push_back("goal");
  table.columns.push_back(std::move(reference));
  options.columns["reference"] = "goal";
  auto const recording = make_recording(table, options, job_section());
  EXPECT_EQ(found(recording, FindingKind::position_factor), nullptr);
  EXPECT_EQ(found(recording, FindingKind::reference_factor), nullptr);
}

TEST(MotionExamination, PositionsOfOtherJointsAreKeptForWhoAsks) {
  auto table = sample_table();
  auto options = sample_options();
  table.names = {"t_s", "q1_rad", "tau_Nm", "q2_rad"};
  options.columns["position"] = "q1_rad";
  EXPECT_EQ(make_recording(table, options, job_section()).other_positions.size(), 0);
  auto const kept = make_recording(table, options, job_section(), OtherJoints::kept);
  EXPECT_EQ(kept.other_columns, std::vector<std::string>{"q2_rad"});
  ASSERT_EQ(kept.other_positions.rows(), kept.position.size());
  EXPECT_LT(largest_difference(kept.other_positions.col(0), table.columns[3]), 1e-9);
}

TEST(MotionExamination, OtherJointsAndStandstillAreSaid) {
  auto table = sample_table();
  auto options = sample_options();
  table.names = {"t_s", "q1_rad", "tau_Nm", "q2_rad"};
  options.columns["position"] = "q1_rad";
  auto const moving = make_recording(table, options, job_section());
  ASSERT_NE(found(moving, FindingKind::other_joints_move), nullptr);
  EXPECT_EQ(found(moving, FindingKind::other_joints_move)->detail, "q2_rad");

  auto still = sample_table({500, 12, 1e-5, 0.0, 0.02, 1});
  std::mt19937 engine(4);
  std::normal_distribution<double> normal;
  for (double& q : still.columns[1]) q = 1e-5 * normal(engine);
  EXPECT_NE(found(make_recording(still, sample_options(), job_section()), FindingKind::standstill), nullptr);
}

}  // namespace recording_faults_test
}  // namespace torquescope
