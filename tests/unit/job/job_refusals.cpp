// What cannot be a job is refused with a place and a way out, never with a crash, a hang or a guess.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "engine/experiment/job/job.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace job_refusals_test {

using ::testing::HasSubstr;

std::vector<Problem> problems_of(std::string const& text) {
  try {
    parse_job(text, "lab.toml");
  } catch (Error const& error) {
    return error.problems();
  }
  ADD_FAILURE() << "accepted: " << text.substr(0, 200);
  return {Problem{}};
}

struct BadText {
  char const* text;
  char const* words;
  int line, column;
};

class BadJobText : public testing::TestWithParam<BadText> {};

TEST_P(BadJobText, IsRefusedWithWordsAndPlace) {
  auto const problem = problems_of(GetParam().text).front();
  EXPECT_EQ(problem.code, ExitCode::bad_job);
  EXPECT_THAT(problem.what, HasSubstr(GetParam().words));
  EXPECT_EQ(problem.place.file, "lab.toml");
  EXPECT_EQ(problem.place.line, GetParam().line);
  EXPECT_EQ(problem.place.column, GetParam().column);
  EXPECT_FALSE(problem.help.empty());
}

TEST(JobText, PathsOfWindowsAreToldFromEscapes) {
  for (auto const* path : {R"("C:\data\x.csv")", R"("C:\Users\x.csv")"}) {
    auto const problem = problems_of(std::string("[recording]\ntrain = ") + path + "\n").front();
    EXPECT_EQ(problem.place.line, 2);
    EXPECT_THAT(problem.help, HasSubstr(R"(write 'C:\data\x.csv' in single quotes)"));
  }
}

TEST(JobText, OtherFilesGivenAsAJobAreNamed) {
  for (auto const& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"<?xml version='1.0'?>\n<robot/>\n", "lab.toml is XML, not a job"},
           {std::string(200, '\0'), "lab.toml holds no text, not a job"}}) {
    auto const problem = problems_of(text).front();
    EXPECT_EQ(problem.what, words);
    EXPECT_THAT(problem.help, HasSubstr("torquescope init"));
  }
  // a job with a mistake stays one
  EXPECT_THAT(problems_of("[model]\nterms = inertia, 2\n1, 2\n").front().what, HasSubstr("this is not TOML"));
}

INSTANTIATE_TEST_SUITE_P(
    EveryKind, BadJobText,
    testing::Values(BadText{"[filter]\ncutoff_hz = 5\ncutoff_hz = 6\n", "\"cutoff_hz\" is written twice", 3, 1},
                    BadText{"[filter]\n[model]\n[filter]\n", "\"filter\" is written twice", 3, 2},
                    BadText{"[filter]\ncutoff_hz = ten\n", "this is not TOML", 2, 14},
                    BadText{"[filter\ncutoff_hz = 1\n", "this is not TOML", 1, 8},
                    BadText{"[filter]\ncutoff_hz = nan\n", "filter.cutoff_hz = nan is not a finite number", 2, 13},
                    BadText{"[filter]\ncutoff_hz = -inf\n", "is not a finite number", 2, 13},
                    BadText{"[filter]\ncutoff_hz = 1e400\n", "'1e400' could not be interpreted", 2, 13},
                    BadText{"[experiment]\nseed = 99999999999999999999\n", "not representable in 64 bits", 2, 8},
                    BadText{"[experiment]\nname = 1979-05-27\n", "experiment.name is a date", 2, 8},
                    BadText{"[model]\nterms = [\"inertia\", 2]\n", "model.terms mixes texts and numbers", 2, 21},
                    BadText{"[model]\nterms = [[1, 2], [3]]\n", "model.terms is a list of lists", 2, 9},
                    BadText{"[model]\nbox = [1, inf]\n", "holds inf, which is not a finite number", 2, 11},
                    BadText{"[recording]\ncolumns = {time = 3}\n", "recording.columns.time is not a text", 2, 19},
                    BadText{"seed = 3\n", "\"seed\" stands outside of any section", 1, 1},
                    BadText{"[[filter]]\ncutoff_hz = 3\n", "[[filter]] is written as a list", 1, 1},
                    BadText{"[experiment]\nname = \"\xff\"\n", "invalid utf-8", 2, 8},
                    BadText{"[experiment]\nname = \"a\x01\"\n", "control character", 2, 10}));

TEST(JobRefusals, ComeAllAtOnceInTheOrderOfTheFile) {
  auto const problems = problems_of("[b]\nx = nan\n[a]\ny = 1979-05-27\nz = [1, true]\n");
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[0].key, "b.x");
  EXPECT_EQ(problems[1].key, "a.y");
  EXPECT_EQ(problems[2].key, "a.z");
}

TEST(JobRefusals, ANestingBombNeverReachesTheParser) {
  for (std::string const& bomb : {std::string("x = ") + std::string(500'000, '['), std::string(500'000, '{'), [] {
                                    std::string header = "[a";
                                    for (int i = 0; i < 400'000; ++i) header += ".a";
                                    return header + "]\n";
                                  }()})
    EXPECT_THAT(problems_of(bomb).front().what, HasSubstr("nested deeper than 32 levels"));
}

TEST(JobRefusals, MoreThanOneMebibyteIsNoJob) {
  std::string text(1 << 20, '#');
  EXPECT_NO_THROW(parse_job(text, "lab.toml"));
  EXPECT_THAT(problems_of(text + "#").front().what, HasSubstr("larger than 1 MiB"));
}

class JobFile : public testing::Test {
 protected:
  Problem problem_of(std::string const& name) const {
    try {
      read_job(folder_ / name);
    } catch (Error const& error) {
      return error.problems().front();
    }
    ADD_FAILURE() << "accepted: " << name;
    return {};
  }

  test::TemporaryFolder folder_{};
};

TEST_F(JobFile, ThatIsMissingNamesItsNeighbour) {
  folder_.write("lab_joint.toml", "[experiment]\n");
  Problem const problem = problem_of("lab_jiont.toml");
  EXPECT_EQ(problem.code, ExitCode::no_input);
  EXPECT_THAT(problem.what, HasSubstr("no such file"));
  EXPECT_THAT(problem.help, HasSubstr("lab_joint.toml"));
}

TEST_F(JobFile, ThatIsAFifoDoesNotHang) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.toml").c_str(), 0600), 0);
  EXPECT_EQ(problem_of("pipe.toml").code, ExitCode::no_input);
}

TEST_F(JobFile, ThatIsAFolderIsRefused) {
  std::filesystem::create_directory(folder_ / "folder.toml");
  EXPECT_THAT(problem_of("folder.toml").what, HasSubstr("not a regular file"));
}

TEST_F(JobFile, IsReadWhole) {
  Job const job = read_job(folder_.write("good.toml", "[experiment]\nseed = 7\n"));
  EXPECT_EQ(std::get<std::int64_t>(job.find("experiment")->find("seed")->value), 7);
}

}  // namespace job_refusals_test
}  // namespace torquescope
