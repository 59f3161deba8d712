#include "engine/workflows/drafts/job_draft.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>

#include "engine/base/error.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/workflows/drafts/draft_text.hpp"
#include "engine/workflows/workflows.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace job_draft_test {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class JobDraftTest : public ::testing::Test {
 protected:
  // a joint with friction on two sines; `cell`: what the three columns hold, in the units of the header
  std::filesystem::path write(std::string const& name, std::string const& header, double time_unit = 1.0,
                              double position_unit = 1.0, double weight = 0.0, double phase = 0.0) {
    std::string text = header + "\n";
    for (int k = 0; k < 3000; ++k) {
      double const t = k / 250.0, a = 2 * M_PI * 0.5, b = 2 * M_PI * 1.3;
      double const q = 0.8 * std::sin(a * t + phase) + 0.3 * std::sin(b * t + 0.4);
      double const dq = 0.8 * a * std::cos(a * t + phase) + 0.3 * b * std::cos(b * t + 0.4);
      double const ddq = -0.8 * a * a * std::sin(a * t + phase) - 0.3 * b * b * std::sin(b * t + 0.4);
      double const noise = 0.02 * std::sin(12.9898 * k * k);
      double const tau = 0.05 * ddq + 0.1 * dq + (dq > 0 ? 0.3 : -0.2) + weight * std::sin(q) + noise;
      text += fmt::format("{:.9g},{:.9g},{:.7g}\n", t / time_unit, q / position_unit, tau);
    }
    return folder_.write(name, text);
  }

  // the file with a commanded position, a little before the measured one; a switch in place of its third column
  static std::string with_goal(std::filesystem::path const& file, bool is_switch = false) {
    std::ifstream rows(file);
    std::string line, text;
    for (int k = 0; std::getline(rows, line); ++k) {
      double const t = (k + 19) / 250.0, goal = 0.8 * std::sin(M_PI * t) + 0.3 * std::sin(2.6 * M_PI * t + 0.4);
      if (is_switch && k > 0) line = line.substr(0, line.rfind(',')) + ",1";
      text += k == 0 ? line + ",goal_rad\n" : fmt::format("{},{:.6g}\n", line, goal);
    }
    return text;
  }

  JobDraft draft(std::vector<std::filesystem::path> const& files, std::size_t joint = 0) {
    return draft_job(files, folder_ / "job.toml", joint);
  }

  std::size_t warnings_of_check(JobDraft const& made) {
    auto const experiment = Experiment::load(parse_job(made.text, folder_ / "job.toml"), Experiment::Purpose::check);
    std::size_t count = 0;
    for (auto const& line : experiment.check(1)) count += line.level == CheckLine::Level::warn;
    return count;
  }

  test::TemporaryFolder folder_;
};

TEST_F(JobDraftTest, OfAnOrdinaryFilePassesCheckAsItIs) {
  auto const made = draft({write("arm.csv", "t_s,q_rad,tau_Nm")});
  EXPECT_THAT(made.warnings, IsEmpty());
  EXPECT_EQ(warnings_of_check(made), 0u);
  EXPECT_THAT(made.text, AllOf(HasSubstr("name = \"arm\""), HasSubstr("time = \"t_s\""), HasSubstr("(250 Hz)"),
                               HasSubstr("terms = [\"inertia\", \"viscous\", \"coulomb\", \"offset\"]"),
                               HasSubstr("# validate = "), HasSubstr("[diagnose]")));
}

TEST_F(JobDraftTest, TheFirstRecordingTrainsAndOthersValidate) {
  auto const one = write("one.csv", "t_s,q_rad,tau_Nm"), two = write("two.csv", "t_s,q_rad,tau_Nm", 1, 1, 0, 0.7);
  auto const made = draft({one, two});
  EXPECT_THAT(made.text, HasSubstr("validate = " + toml_text(two.string())));
  EXPECT_THAT(made.warnings, IsEmpty());
  // what cannot judge the first is left out, with its reason
  auto const other = write("other.csv", "t_s,angle,force");
  auto const slower = write("slower.csv", "t_s,q_rad,tau_Nm", 0.5);
  auto const left_out = draft({one, one, other, slower});
  EXPECT_THAT(left_out.warnings, Contains(HasSubstr("it is the same recording as train")));
  EXPECT_THAT(left_out.warnings, Contains(HasSubstr("no column \"")));
  EXPECT_THAT(left_out.warnings, Contains(HasSubstr("it has 125 Hz, train 250 Hz")));
  EXPECT_EQ(warnings_of_check(left_out), 0u);
}

TEST_F(JobDraftTest, UnitsOfTheNamesAreWritten) {
  double const degree = M_PI / 180;
  auto const made = draft({write("arm.csv", "Time [ms],angle [deg],torque [Nm]", 1e-3, degree)});
  EXPECT_THAT(made.text, HasSubstr("position_per_unit = 0.0174532925"));
  EXPECT_EQ(warnings_of_check(made), 0u);
}

TEST_F(JobDraftTest, WhatNobodyCanGuessIsALineToEditAndAWarning) {
  auto const made = draft({write("arm.csv", "t_s,pos_cnt,i_mA", 1, 1e-4)});
  EXPECT_THAT(made.text, AllOf(HasSubstr("# torque_per_unit = <N m per mA>"),
                               HasSubstr("# position_per_unit = <rad per count>"), HasSubstr("EDIT")));
  EXPECT_THAT(made.warnings, Contains(HasSubstr("torque \"i_mA\" is a current in mA")));
  EXPECT_THAT(made.warnings, Contains(HasSubstr("position \"pos_cnt\" is in counts")));
  EXPECT_NO_THROW(warnings_of_check(made)) << "it runs until then, in units of the columns";

  auto const unknown = draft({write("odd.csv", "t_s,a,b")});
  EXPECT_THAT(unknown.text, HasSubstr("# position = \"<column>\""));
  EXPECT_THAT(unknown.warnings, Contains(HasSubstr("no column looks like the torque")));
}

TEST_F(JobDraftTest, AWeightIsATermWhereTheTorqueShowsIt) {
  EXPECT_THAT(draft({write("light.csv", "t_s,q_rad,tau_Nm")}).text, Not(HasSubstr("\"gravity\"")));
  EXPECT_THAT(draft({write("heavy.csv", "t_s,q_rad,tau_Nm", 1, 1, 2.0)}).text, HasSubstr("\"gravity\""));
  EXPECT_THAT(draft({write("slide.csv", "t_s,q_m,F_N", 1, 1, 2.0)}).text,
              AllOf(HasSubstr("joint = \"prismatic\""), Not(HasSubstr("\"gravity\""))));
}

TEST_F(JobDraftTest, RefusesAJointThatIsNotThere) {
  auto const file = write("arm.csv", "t_s,q_rad,tau_Nm");
  try {
    draft({file}, 2);
    ADD_FAILURE() << "accepted";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_THAT(error.problems().front().what, HasSubstr("has 1 joint, no joint 2"));
  }
}

TEST_F(JobDraftTest, WhatDoesNotRunYetHasACode) {
  EXPECT_EQ(draft({write("arm.csv", "t_s,q_rad,tau_Nm")}).code, ExitCode::ok);
  EXPECT_EQ(draft({write("drive.csv", "t_s,q_rad,i_A")}).code, ExitCode::ok) << "it runs, in N m per A";
  auto const unknown = draft({write("odd.csv", "t_s,a,b")});
  EXPECT_EQ(unknown.code, ExitCode::bad_job);
  EXPECT_THAT(unknown.warnings, Contains(HasSubstr("this job does not run yet: write what stands behind EDIT")));
  auto const still = draft({folder_.write("still.csv", "t_s,q_rad,tau_Nm\n0,1,1\n1,1,2\n2,1,3\n3,1,1\n")});
  EXPECT_EQ(still.code, ExitCode::bad_data);
  EXPECT_THAT(still.warnings, Contains(HasSubstr("this job does not run yet: ")));
}

TEST_F(JobDraftTest, ATorqueBesideAReferenceIsAJointAndAServoWhereOneSaysSo) {
  auto const file = write("servo.csv", "t_s,q_rad,V_V");
  EXPECT_THAT(draft({file}).text, Not(HasSubstr("init --servo")));
  auto const both = folder_.write("both.csv", with_goal(folder_.path() / "servo.csv"));
  auto const joint = draft({both});
  EXPECT_THAT(joint.text, AllOf(HasSubstr("torque = \"V_V\""), HasSubstr("init --servo FILES")));
  auto const servo = draft_job({both}, folder_ / "job.toml", 0, DraftKind::servo);
  EXPECT_THAT(servo.text,
              AllOf(HasSubstr("[[recordings]]"), Not(HasSubstr("V_V")), HasSubstr("reference = \"goal_rad\"")));
  EXPECT_EQ(servo.code, ExitCode::ok) << fmt::format("{}", fmt::join(servo.warnings, "\n"));
  // without a command there is nothing to simulate
  auto const no_command = draft_job({file}, folder_ / "job.toml", 0, DraftKind::servo);
  EXPECT_EQ(no_command.code, ExitCode::bad_job);
  EXPECT_THAT(no_command.text, HasSubstr("# reference = \"<column>\""));
}

TEST_F(JobDraftTest, CommandAndPositionWithoutATorqueAreAServo) {
  write("servo.csv", "t_s,q_rad,torque_enabled", 1, 1, 0);
  std::vector<std::filesystem::path> files{folder_.write("table.csv", "file,mass_kg\nm1_l150_kp8_a.csv,1\n")};
  for (char const* name : {"m1_l150_kp8_a.csv", "m2_l150_kp8_a.csv", "m2_l150_kp32_a.csv"})
    files.push_back(folder_.write(name, with_goal(folder_.path() / "servo.csv", true)));
  auto const made = draft(files);
  EXPECT_EQ(made.code, ExitCode::ok) << fmt::format("{}", fmt::join(made.warnings, "\n"));
  EXPECT_THAT(
      made.text,
      AllOf(HasSubstr("m{mass_kg}_l{length_mm}_kp{kp}_a.csv"), HasSubstr("enabled = \"torque_enabled\""),
            HasSubstr("gravity_moment = \"9.80665 * mass_kg * 0.001 * length_mm\""), HasSubstr("\n# command_gain = "),
            HasSubstr("drive = \"position servo\""), HasSubstr("[diagnose]"), HasSubstr("No recording judges")));
  EXPECT_THAT(made.warnings, Contains(HasSubstr("table.csv is left out: it looks like a table of recordings")));
  EXPECT_THAT(made.warnings, Contains(HasSubstr("kp differs between these recordings")));
  // names that tell no load: [known] has lines to edit, and the job runs without them
  EXPECT_THAT(draft({files[1]}).text, HasSubstr("name = \"m1_l150_kp8_a\""));
  auto const plain = draft({folder_.write("x.csv", with_goal(folder_.path() / "servo.csv", true))});
  EXPECT_EQ(plain.code, ExitCode::ok);
  EXPECT_THAT(plain.text, AllOf(HasSubstr("\n# gravity_moment = "),
                                HasSubstr("files = " + toml_text((folder_.path() / "x.csv").string()))));
}

TEST_F(JobDraftTest, WithBareNamesItAsksAndTakesTheColumnsThatAreNamed) {
  auto const file = write("bare.csv", "a,b,c");
  auto const asked = draft({file});
  EXPECT_EQ(asked.code, ExitCode::bad_job);
  EXPECT_THAT(asked.looks, Contains(HasSubstr("\"a\": runs forwards")));
  EXPECT_THAT(asked.looks, Contains(AllOf(HasSubstr("\"b\": "), HasSubstr("as a position"))));
  EXPECT_THAT(asked.looks, Contains(AllOf(HasSubstr("\"c\": "), HasSubstr("of \"b\" explain"))));
  EXPECT_THAT(asked.text, HasSubstr("# \"b\": "));

  auto const job = folder_ / "job.toml";
  auto const named =
      draft_job({file}, job, 0, DraftKind::of_the_files, {{"position", "b"}, {"torque", "c"}, {"time", "a"}});
  EXPECT_EQ(named.code, ExitCode::ok) << fmt::format("{}", fmt::join(named.warnings, "\n"));
  EXPECT_THAT(named.text, AllOf(HasSubstr("position = \"b\""), HasSubstr("torque = \"c\""), HasSubstr("as you said")));
  try {
    draft_job({file}, job, 0, DraftKind::of_the_files, {{"torque", "tau"}});
    ADD_FAILURE() << "accepted";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_THAT(error.problems().front().what, HasSubstr("--torque \"tau\": bare.csv has no such column"));
    EXPECT_THAT(error.problems().front().help, HasSubstr("a, b, c"));
  }
  // a name against the guess
  auto const two = write("two.csv", "t_s,q_rad,tau_Nm");
  auto const swapped = draft_job({two}, job, 0, DraftKind::of_the_files, {{"position", "tau_Nm"}});
  EXPECT_THAT(swapped.text, AllOf(HasSubstr("position = \"tau_Nm\""), HasSubstr("# torque = \"<column>\"")));
}

TEST_F(JobDraftTest, AReferenceThatIsTheNextPositionIsNotUsed) {
  std::ifstream rows(write("arm.csv", "t_s,q_rad,tau_Nm"));
  std::string line, text, before;
  for (int k = 0; std::getline(rows, line); before = line, ++k) {
    if (k == 1) text += before + ",action\n";
    auto const q = line.substr(line.find(',') + 1);
    if (k > 1) text += before + "," + q.substr(0, q.find(',')) + "\n";
  }
  auto const made = draft({folder_.write("imitation.csv", text)});
  EXPECT_EQ(made.code, ExitCode::ok) << fmt::format("{}", fmt::join(made.warnings, "\n"));
  EXPECT_THAT(made.text, AllOf(Not(HasSubstr("\nreference = ")), HasSubstr("1 row ahead")));
  EXPECT_THAT(made.guesses, Contains(HasSubstr("1 row ahead")));
}

TEST_F(JobDraftTest, PathsAreRelativeToTheJob) {
  write("arm.csv", "t_s,q_rad,tau_Nm");
  auto const here = std::filesystem::relative(folder_ / "arm.csv");
  auto const made = draft_job({here}, folder_ / "jobs" / "arm.toml");
  EXPECT_THAT(made.text, HasSubstr("train = \"../arm.csv\""));
}

TEST(DraftText, EscapesWhatTomlWouldMisread) {
  std::string const awkward = "C:\\arm \"left\"\t.csv";
  Job const job = parse_job("[recording]\ntrain = " + toml_text(awkward) + "\n", "job.toml");
  EXPECT_EQ(std::get<std::string>(job.find("recording")->find("train")->value), awkward);
}

}  // namespace job_draft_test
}  // namespace torquescope
