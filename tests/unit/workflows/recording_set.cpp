// Many recordings in one job: what [[recordings]] and [known] make of files, and every refusal with its way out.

#include "engine/experiment/recording_set.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/workflows/workflows.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace recording_set_test {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class RecordingSet : public testing::Test {
 protected:
  RecordingSet() {
    std::filesystem::create_directory(folder.path() / "train");
    std::filesystem::create_directory(folder.path() / "test");
  }

  void touch(std::vector<std::string> const& files) const {
    for (auto const& file : files) folder.write(file, "x");
  }
  Job job_of(std::string const& text) const { return parse_job(text, folder.path() / "job.toml"); }
  std::vector<SetEntry> entries_of(std::string const& text) const {
    std::vector<Problem> problems;
    auto entries = read_recording_set(job_of(text), problems);
    for (auto const& problem : problems) ADD_FAILURE() << problem.what;
    return entries;
  }
  std::vector<Problem> problems_of(std::string const& text) const {
    std::vector<Problem> problems;
    read_recording_set(job_of(text), problems);
    return problems;
  }
  // the only one
  Problem problem_of(std::string const& text) const {
    auto const problems = problems_of(text);
    EXPECT_EQ(problems.size(), 1u);
    for (std::size_t k = 1; k < problems.size(); ++k) ADD_FAILURE() << problems[k].what;
    return problems.empty() ? Problem{} : problems.front();
  }

  test::TemporaryFolder const folder;
};

std::string const pattern = R"(
[[recordings]]
files = "train/servo_m{mass_kg}_l{length_mm}_kp{kp}_{motion}.csv.gz"
supply_v = 12.0
motor = "MX-64"
)";

void expect_problem(Problem const& problem, ExitCode code, int line, std::string const& key, std::string const& what,
                    std::string const& help) {
  EXPECT_EQ(problem.code, code);
  EXPECT_EQ(problem.place.line, line);
  EXPECT_FALSE(problem.place.file.empty());
  EXPECT_EQ(problem.key, key);
  EXPECT_THAT(problem.what, HasSubstr(what));
  EXPECT_THAT(problem.help, HasSubstr(help));
}

// ---- patterns

TEST_F(RecordingSet, TakesQuantitiesFromNamesAndFromItsSection) {
  touch({"train/servo_m0.5_l150_kp32_sin_sin.csv.gz", "train/servo_m0.2_l100_kp8_lift.csv.gz", "train/other.csv.gz"});
  auto const entries = entries_of(pattern);
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].name, "servo_m0.2_l100_kp8_lift.csv.gz");
  EXPECT_EQ(entries[1].path, folder.path() / "train/servo_m0.5_l150_kp32_sin_sin.csv.gz");
  EXPECT_EQ(entries[1].numbers,
            (std::map<std::string, double>{{"mass_kg", 0.5}, {"length_mm", 150}, {"kp", 32}, {"supply_v", 12}}));
  EXPECT_EQ(entries[1].words, (std::map<std::string, std::string>{{"motion", "sin_sin"}, {"motor", "MX-64"}}));
  EXPECT_FALSE(entries[0].is_validation);
  EXPECT_TRUE(std::isinf(entries[0].known.command_limit));
}

TEST_F(RecordingSet, IsAWordWhereOneMatchIsNoNumber) {
  touch({"train/kp8.csv", "train/kp8old.csv"});
  auto const entries = entries_of("[[recordings]]\nfiles = \"train/kp{kp}.csv\"");
  EXPECT_EQ(entries[0].words.at("kp"), "8");
  EXPECT_TRUE(entries[0].numbers.empty());
}

TEST_F(RecordingSet, JoinsSectionsInTheirOrderAndNamesFilesOfOneNameByFolder) {
  touch({"train/a.csv", "test/a.csv", "test/b.csv"});
  auto const entries = entries_of(
      "[[recordings]]\nfiles = \"test/*.csv\"\nrole = \"validate\"\n[[recordings]]\nfiles = \"train/?.csv\"");
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[0].name, "test/a.csv");
  EXPECT_EQ(entries[1].name, "b.csv");
  EXPECT_EQ(entries[2].name, "train/a.csv");
  EXPECT_TRUE(entries[1].is_validation);
  EXPECT_FALSE(entries[2].is_validation);
}

TEST_F(RecordingSet, IsAbsentFromOtherJobs) {
  EXPECT_FALSE(has_recording_set(job_of("[recording]\ntrain = \"a.csv\"")));
  EXPECT_TRUE(has_recording_set(job_of(pattern)));
  EXPECT_TRUE(entries_of("[recording]\ntrain = \"a.csv\"").empty());
}

TEST_F(RecordingSet, RefusesAPatternThatMatchesNothingAndSaysWhatIsThere) {
  touch({"train/servo_1.csv"});
  auto const problem = problem_of("[[recordings]]\nfiles = \"train/servo_{n}.csv.gz\"");
  expect_problem(problem, ExitCode::no_input, 2, "recordings.files", "matches no file", "relative to the job");
  ASSERT_EQ(problem.notes.size(), 2u);
  EXPECT_THAT(problem.notes[0], HasSubstr("servo_1.csv"));
  EXPECT_THAT(problem.notes[1], HasSubstr("\"train/servo_{n}.csv\" matches 1 file"));
}

TEST_F(RecordingSet, RefusesAPatternThatIsNone) {
  expect_problem(problem_of("[[recordings]]\nfiles = \"m{m.csv\""), ExitCode::bad_job, 2, "recordings.files",
                 "a { is never closed", "write");
}

TEST_F(RecordingSet, RefusesFilesAndManifestTogetherAndNeither) {
  expect_problem(problem_of("[[recordings]]\nfiles = \"*.csv\"\nmanifest = \"a.csv\""), ExitCode::bad_job, 3,
                 "recordings.manifest", "both files and manifest", "two [[recordings]]");
  expect_problem(problem_of("[[recordings]]\nrole = \"train\""), ExitCode::bad_job, 1, "recordings",
                 "neither files nor manifest", "files = ");
}

TEST_F(RecordingSet, RefusesAnUnknownRoleAndAMisspeltKey) {
  auto const role = problem_of("[[recordings]]\nfiles = \"*.csv\"\nrole = \"test\"");
  expect_problem(role, ExitCode::bad_job, 3, "recordings.role", "role = \"test\"", "role = ");
  auto const key = problems_of("[[recordings]]\nfile = \"*.csv\"");
  expect_problem(key.front(), ExitCode::bad_job, 2, "recordings.file", "unknown key \"file\"", "is a quantity");
  EXPECT_EQ(key.front().caret_note, "did you mean \"files\"?");
}

TEST_F(RecordingSet, RefusesAQuantityThatIsAListOrHasTwoSources) {
  touch({"train/m1.csv"});
  expect_problem(problem_of("[[recordings]]\nfiles = \"train/*.csv\"\nmass_kg = [1, 2]"), ExitCode::bad_job, 3,
                 "recordings.mass_kg", "list of numbers", "a number or a text");
  expect_problem(problem_of("[[recordings]]\nfiles = \"train/m{mass_kg}.csv\"\nmass_kg = 1"), ExitCode::bad_job, 3,
                 "recordings.mass_kg", "in [[recordings]] and in its pattern", "remove one");
}

TEST_F(RecordingSet, RefusesAFileThatIsThereTwice) {
  touch({"train/a.csv", "train/b.csv"});
  auto const problem = problem_of("[[recordings]]\nfiles = \"train/*.csv\"\n[[recordings]]\nfiles = \"train/{n}.csv\"");
  expect_problem(problem, ExitCode::bad_job, 4, "recordings", "2 files are in the set twice", "narrow one");
  EXPECT_THAT(problem.notes, ElementsAre(HasSubstr("job.toml:2")));
}

TEST_F(RecordingSet, RefusesToHaveNoTrainingRecording) {
  touch({"train/a.csv"});
  expect_problem(problem_of("[[recordings]]\nfiles = \"train/*.csv\"\nrole = \"validate\""), ExitCode::bad_job, 3,
                 "recordings.role", "none of the 1 recordings is for training", "role = \"train\"");
}

TEST_F(RecordingSet, RefusesRecordingTrainBesideIt) {
  touch({"train/a.csv"});
  expect_problem(problem_of("[recording]\ntrain = \"a.csv\"\n[[recordings]]\nfiles = \"train/*.csv\""),
                 ExitCode::bad_job, 2, "recording.train", "both recording.train and [[recordings]]", "remove this key");
}

TEST_F(RecordingSet, IsRefusedByCommandsThatReadRecordingTrain) {
  try {
    Experiment::load(job_of("[[recordings]]\nfiles = \"*.csv\"\n[model]\nterms = [\"inertia\"]"),
                     Experiment::Purpose::check);
    ADD_FAILURE() << "nothing was thrown";
  } catch (Error const& error) {
    EXPECT_THAT(error.problems().front().what, HasSubstr("the job has [[recordings]]"));
    EXPECT_EQ(error.problems().front().place.line, 1);
  }
}

// ---- manifests

TEST_F(RecordingSet, ReadsAManifestWithRolesNumbersWordsAndGaps) {
  touch({"train/a.csv", "train/b,1.csv", "train/c.csv"});
  folder.write("train/records.csv",
               "file,role,mass_kg,motion\na.csv,,0.5,lift\n\"b,1.csv\",validate,,sin\nc.csv,train,2,\n");
  auto const entries = entries_of("[[recordings]]\nmanifest = \"train/records.csv\"\nsupply_v = 7.4");
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[0].path, folder.path() / "train/a.csv");
  EXPECT_EQ(entries[0].numbers, (std::map<std::string, double>{{"mass_kg", 0.5}, {"supply_v", 7.4}}));
  EXPECT_EQ(entries[1].name, "b,1.csv");
  EXPECT_TRUE(entries[1].is_validation);
  EXPECT_FALSE(entries[1].numbers.contains("mass_kg"));
  EXPECT_EQ(entries[1].words.at("motion"), "sin");
  EXPECT_TRUE(entries[2].words.empty());
  EXPECT_EQ(entries[2].place.line, 4);
}

TEST_F(RecordingSet, ReadsAManifestWithSemicolonsAndDecimalCommas) {
  touch({"a.csv"});
  folder.write("records.csv",
               "\xEF\xBB\xBF"
               "file;mass_kg\r\na.csv;0,25\r\n");
  EXPECT_EQ(entries_of("[[recordings]]\nmanifest = \"records.csv\"")[0].numbers.at("mass_kg"), 0.25);
}

TEST_F(RecordingSet, RefusesAManifestThatIsMissingOrEmpty) {
  std::string const job = "[[recordings]]\nmanifest = \"records.csv\"";
  expect_problem(problem_of(job), ExitCode::no_input, 2, "recordings.manifest", "records.csv", "");
  folder.write("records.csv", "");
  EXPECT_EQ(problem_of(job).code, ExitCode::bad_data);
  EXPECT_THAT(problem_of(job).what, HasSubstr("records.csv is empty"));
  folder.write("records.csv", "file,mass_kg\n\n");
  EXPECT_THAT(problem_of(job).what, HasSubstr("names no recording"));
  EXPECT_THAT(problem_of(job).help, HasSubstr("one line for each recording"));
}

TEST_F(RecordingSet, RefusesFilesOfAManifestThatAreMissingEachWithItsLine) {
  touch({"a.csv", "b2.csv"});
  folder.write("records.csv", "file\na.csv\nb.csv\n");
  auto const problem = problem_of("[[recordings]]\nmanifest = \"records.csv\"");
  expect_problem(problem, ExitCode::no_input, 3, "recordings.manifest", "b.csv", "correct \"b.csv\"");
  EXPECT_THAT(problem.place.file, HasSubstr("records.csv"));
  EXPECT_THAT(problem.notes, Contains(HasSubstr("b2.csv")));
}

TEST_F(RecordingSet, RefusesTextAmongNumbersWithLineAndColumn) {
  touch({"a.csv", "b.csv"});
  folder.write("records.csv", "file,mass_kg\na.csv,0.5\nb.csv,0.5kg\n");
  auto const problem = problem_of("[[recordings]]\nmanifest = \"records.csv\"");
  expect_problem(problem, ExitCode::bad_data, 3, "recordings.manifest", "\"0.5kg\" in column mass_kg is no number",
                 "write a number");
  EXPECT_EQ(problem.place.column, 7);
}

TEST_F(RecordingSet, RefusesWhatIsNoTableOfRecordings) {
  touch({"a.csv"});
  std::string const job = "[[recordings]]\nmanifest = \"records.csv\"";
  folder.write("records.csv", "name,mass_kg\na.csv,1\n");
  EXPECT_THAT(problem_of(job).what, HasSubstr("no column \"file\""));
  EXPECT_THAT(problem_of(job).notes, ElementsAre("its columns: name, mass_kg"));
  folder.write("records.csv", "file,m,m\na.csv,1,2\n");
  EXPECT_THAT(problem_of(job).what, HasSubstr("two columns are called \"m\""));
  folder.write("records.csv", "file,m\na.csv,1,2\n");
  EXPECT_THAT(problem_of(job).what, HasSubstr("line 2 has 3 cells, and the header has 2"));
  folder.write("records.csv", "file,role\na.csv,test\n");
  expect_problem(problem_of(job), ExitCode::bad_data, 2, "recordings.manifest", "role \"test\" is not known",
                 "train or validate");
  folder.write("records.csv", "file,mass_kg\na.csv,1\n");
  expect_problem(problem_of(job + "\nmass_kg = 2"), ExitCode::bad_job, 3, "recordings.mass_kg", "in its manifest",
                 "remove one");
}

// ---- what is known

class KnownOfSet : public RecordingSet {
 protected:
  KnownOfSet() { touch({"train/servo_m0.5_l150_kp32_sin.csv.gz", "train/servo_m0.2_l100_kp8_sin.csv.gz"}); }
  std::string with(std::string const& known) const { return pattern + "[known]\n" + known; }  // its key is in line 7
};

TEST_F(KnownOfSet, IsAProductOfEachRecording) {
  auto const entries = entries_of(with(R"(gravity_moment = "9.80665 * mass_kg * 0.001 * length_mm"
inertia = "mass_kg * 1e-6 * length_mm * length_mm"
command_gain = "0.165 * kp * supply_v"
command_limit = "0.97 * supply_v"
arm_length = "0.001 * length_mm"
temperature = 25)"));
  ASSERT_EQ(entries.size(), 2u);
  auto const& known = entries[1].known;
  EXPECT_NEAR(known.gravity_moment, 9.80665 * 0.5 * 0.15, 1e-12);
  EXPECT_NEAR(known.inertia, 0.5 * 0.15 * 0.15, 1e-12);
  EXPECT_NEAR(known.command_gain, 0.165 * 32 * 12, 1e-12);
  EXPECT_NEAR(known.command_limit, 0.97 * 12, 1e-12);
  EXPECT_NEAR(known.arm_length, 0.15, 1e-12);
  EXPECT_EQ(known.temperature, 25.0);
  EXPECT_NEAR(entries[0].known.gravity_moment, 9.80665 * 0.2 * 0.1, 1e-12);
}

TEST_F(KnownOfSet, SaysWhichKeysWereGiven) {
  auto const keys = known_keys(job_of(with("inertia = 0.1")));
  EXPECT_TRUE(keys.inertia);
  EXPECT_FALSE(keys.gravity_moment);
  EXPECT_FALSE(known_keys(job_of(pattern)).inertia);
}

TEST_F(KnownOfSet, RefusesAnUnknownKey) {
  auto const problem = problem_of(with("gravity = 1"));
  expect_problem(problem, ExitCode::bad_job, 7, "known.gravity", "unknown key \"gravity\"", "gravity_moment, inertia");
}

TEST_F(KnownOfSet, RefusesAnUnknownQuantityWithTheNearestName) {
  auto const problem = problem_of(with("command_gain = \"0.165 * kd\""));
  expect_problem(problem, ExitCode::bad_job, 7, "known.command_gain", "names kd", "write kd = <number>");
  EXPECT_EQ(problem.caret_note, "did you mean kp?");
  EXPECT_THAT(problem.notes, ElementsAre("quantities: kp, length_mm, mass_kg, motion, motor, supply_v"));
}

TEST_F(KnownOfSet, AsksForNoQuantityOfRecordingsThatWereNotFound) {
  auto const job = with("command_gain = \"gain\"\n[[recordings]]\nfiles = \"test/{gain}.csv\"");
  expect_problem(problem_of(job), ExitCode::no_input, 9, "recordings.files", "matches no file", "relative to the job");
}

TEST_F(KnownOfSet, SaysTheFactorWhereOnlyTheUnitDiffers) {
  auto const problem = problem_of(with("gravity_moment = \"9.80665 * mass_kg * length_m\""));
  expect_problem(problem, ExitCode::bad_job, 7, "known.gravity_moment", "names length_m",
                 "gravity_moment = \"9.80665 * mass_kg * 0.001 * length_mm\"");
}

TEST_F(KnownOfSet, RefusesAUnitThatIsCertainlyForgotten) {
  expect_problem(problem_of(with("arm_length = \"length_mm\"")), ExitCode::bad_job, 7, "known.arm_length",
                 "arm_length is in m, and length_mm is in mm", "arm_length = \"0.001 * length_mm\"");
  expect_problem(problem_of(with("gravity_moment = \"9.81 * mass_kg * length_mm\"")), ExitCode::bad_job, 7,
                 "known.gravity_moment", "length_mm is in mm", "9.81 * mass_kg * 0.001 * length_mm");
  EXPECT_TRUE(problems_of(with("gravity_moment = \"0.00981 * mass_kg * length_mm\"")).empty());
}

TEST_F(KnownOfSet, RefusesTextAndQuantitiesThatSomeRecordingsLack) {
  expect_problem(problem_of(with("command_gain = \"motion\"")), ExitCode::bad_job, 7, "known.command_gain",
                 "needs motion, which is text (\"sin\")", "a number of every recording");
  touch({"test/a.csv"});
  auto const job = with("command_gain = \"kp\"\n[[recordings]]\nfiles = \"test/*.csv\"");
  expect_problem(problem_of(job), ExitCode::bad_job, 7, "known.command_gain",
                 "needs kp, which 1 of 3 recordings do not have: a.csv (job.toml:9)", "write kp in their");
}

TEST_F(KnownOfSet, RefusesWhatIsNoProductAndValuesOutOfRange) {
  expect_problem(problem_of(with("command_gain = \"kp / 2\"")), ExitCode::bad_job, 7, "known.command_gain",
                 "is no product", "factors joined by *");
  expect_problem(problem_of(with("command_gain = true")), ExitCode::bad_job, 7, "known.command_gain",
                 "a number or a text is wanted", "factors joined by *");
  expect_problem(problem_of(with("inertia = \"-1 * mass_kg\"")), ExitCode::bad_job, 7, "known.inertia",
                 "inertia is -0.2 kg m2 of servo_m0.2", "at least 0");
  expect_problem(problem_of(with("command_limit = 0")), ExitCode::bad_job, 7, "known.command_limit", "is 0 command",
                 "above 0");
}

TEST_F(RecordingSet, RefusesOneQuantityInTwoUnits) {
  touch({"train/l0.1.csv", "test/l100.csv"});
  auto const problem = problem_of(
      "[[recordings]]\nfiles = \"train/l{length_m}.csv\"\n[[recordings]]\nfiles = \"test/l{length_mm}.csv\"");
  expect_problem(problem, ExitCode::bad_job, 4, "recordings.length_mm", "length_m and length_mm are one quantity",
                 "length_m = 0.001 * length_mm");
}

// ---- the recordings themselves

// a servo that follows its command, and stands still at zero for 0.1 s before
std::string servo_text(double rate_hz, bool has_enabled) {
  std::string text = has_enabled ? "t_s,goal_deg,q_deg,on\n" : "t_s,goal_deg,q_deg\n";
  for (int k = 0; k < 4 * rate_hz; ++k) {
    double const t = k / rate_hz, moving = std::max(0.0, t - 0.1);
    double const q = 40 * std::sin(3 * moving) * std::sin(1.1 * moving);
    text += fmt::format("{:.6f},{:.5f},{:.5f}", t, 40 * std::sin(3.1 * moving) * std::sin(1.1 * moving), q);
    text += has_enabled ? (t < 3.0 ? ",1\n" : ",0\n") : "\n";
  }
  return text;
}

class FilesOfSet : public RecordingSet {
 protected:
  std::vector<SetRecording> read(std::string const& columns) const {
    auto const job = job_of(fmt::format(R"([recording]
columns = {{{}}}
position_per_unit = 0.0174532925199433
[[recordings]]
files = "train/kp{{kp}}.csv"
[[recordings]]
files = "test/*.csv"
role = "validate")",
                                        columns));
    std::vector<Problem> problems;
    auto const entries = read_recording_set(job, problems);
    EXPECT_TRUE(problems.empty());
    return read_recordings(job, entries);
  }
};

TEST_F(FilesOfSet, NeedNoTorqueAndComeAtOneRate) {
  folder.write("train/kp8.csv", servo_text(100, false));
  folder.write("train/kp16.csv", servo_text(100, true));
  folder.write("test/a.csv", servo_text(200, false));
  auto const set = read(R"(time = "t_s", reference = "goal_deg", position = "q_deg", enabled = "on")");
  ASSERT_EQ(set.size(), 3u);
  EXPECT_EQ(set[0].recording.name, "kp16.csv");
  EXPECT_EQ(set[0].entry.numbers.at("kp"), 16);
  for (auto const& one : set) {
    EXPECT_NEAR(one.recording.rate_hz, 100, 1e-3);
    ASSERT_EQ(one.recording.torque.size(), one.recording.position.size());
    EXPECT_EQ(one.recording.torque.norm(), 0.0);
    EXPECT_EQ(one.recording.reference.size(), one.recording.position.size());
    EXPECT_NEAR(one.recording.position.maxCoeff(), 40 * M_PI / 180, 0.3);
    EXPECT_EQ(one.recording.rows.torque_limit_share, 0.0);
    EXPECT_TRUE(one.recording.left_out.empty()) << one.recording.name;  // rest at zero is no fault of a logger
  }
  EXPECT_EQ(set[0].recording.enabled.size(), set[0].recording.position.size());
  EXPECT_EQ(set[0].recording.enabled.minCoeff(), 0.0);
  EXPECT_EQ(set[1].recording.enabled.size(), 0);
  EXPECT_TRUE(set[2].entry.is_validation);
  ASSERT_FALSE(set[2].recording.warnings.empty());
  EXPECT_THAT(set[2].recording.warnings.back().text, HasSubstr("resampled"));
}

TEST_F(FilesOfSet, NeedAPositionAndAnInputThatOneOfThemHas) {
  folder.write("train/kp8.csv", servo_text(100, false));
  folder.write("test/a.csv", servo_text(100, false));
  auto const said = [&](std::string const& columns) {
    try {
      read(columns);
    } catch (Error const& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_job);
      return error.problems().front().what;
    }
    return std::string("nothing");
  };
  EXPECT_EQ(said(R"(time = "t_s", reference = "goal_deg")"), "columns names no position");
  EXPECT_THAT(said(R"(time = "t_s", position = "q_deg", enabled = "onn")"), HasSubstr("no recording has the column"));
}

}  // namespace recording_set_test
}  // namespace torquescope
