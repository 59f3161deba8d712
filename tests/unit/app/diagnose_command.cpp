// `diagnose` as people and scripts meet it, with an invented diagnosis in place of the science: what goes to which
// stream, what is kept in the file, and that a finished job is not diagnosed twice.

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/app/commands/command.hpp"
#include "engine/app/exit_codes.hpp"
#include "engine/app/result/result_summary.hpp"
#include "engine/workflows/diagnosis_result.hpp"
#include "engine/workflows/results/diagnosis_json.hpp"
#include "engine/workflows/results/diagnosis_reader.hpp"
#include "support/example_diagnosis.hpp"
#include "support/simulated_job.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace diagnose_command_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::internal::CaptureStderr;
using ::testing::internal::CaptureStdout;
using ::testing::internal::GetCapturedStderr;
using ::testing::internal::GetCapturedStdout;

std::string const job_text = test::joint_model + test::simulated_joint;

struct Outcome {
  ExitCode code = ExitCode::ok;
  std::string out, err;
};

class DiagnoseCommand : public ::testing::Test {
 protected:
  DiagnoseCommand() { write_job(job_text); }

  void write_job(std::string const& text) const { folder.write("job.toml", text); }

  // torquescope diagnose job.toml --out R.h5 ...
  Outcome run(std::vector<std::string> const& more = {}) {
    CLI::App app("", "torquescope");
    ChosenCommand chosen;
    add_diagnose(app, chosen, [this](auto const& experiment, auto const& request, auto const& progress) {
      ++diagnosed;
      progress({"replicates", 100, 200, 0, 0, 7.0, "replicates"});
      progress({"replicates", 200, 200, 0, 0, 14.0, "replicates"});
      progress({"search", 34, 34, 0, 0, 8.8, "effects"});
      progress({"replicates", 200, 200, 0, 0, 7.4, "replicates"});  // again, with what was named
      Diagnosis const diagnosis = diagnose_into_file(experiment, request, [this] { return found; });
      return diagnosis;
    });
    std::vector<std::string> words{"diagnose", (folder / "job.toml").string(), "--out", result().string()};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<std::string> reversed(words.rbegin(), words.rend());
    app.parse(reversed);
    CaptureStdout();
    CaptureStderr();
    Outcome outcome;
    try {
      outcome.code = chosen.work(Session(chosen.session));
    } catch (Error const& error) {
      outcome.code = error.code();
      std::fputs(error.what(), stderr);
    }
    outcome.out = GetCapturedStdout();
    outcome.err = GetCapturedStderr();
    return outcome;
  }

  // torquescope show R.h5 ...
  Outcome show(std::vector<std::string> const& more = {}) const {
    CLI::App app("", "torquescope");
    ChosenCommand chosen;
    add_show(app, chosen);
    std::vector<std::string> reversed(more.rbegin(), more.rend());
    reversed.insert(reversed.end(), {result().string(), "show"});
    app.parse(reversed);
    CaptureStdout();
    Outcome outcome;
    try {
      outcome.code = chosen.work(Session(chosen.session));
    } catch (Error const& error) {
      outcome.code = error.code();
      outcome.err = error.what();
    }
    outcome.out = GetCapturedStdout();
    return outcome;
  }

  std::filesystem::path result() const { return folder / "R.h5"; }

  test::TemporaryFolder folder{};
  Diagnosis found = example::invented_diagnosis();
  int diagnosed = 0;
};

TEST_F(DiagnoseCommand, PutsTheResultOnStdoutAndTheRestOnStderr) {
  Outcome const outcome = run({"--progress", "none"});
  EXPECT_EQ(outcome.code, ExitCode::ok);
  EXPECT_THAT(outcome.out, HasSubstr("NAMED  Stribeck friction 0.35 N m [0.34, 0.37]"));
  EXPECT_THAT(outcome.out, HasSubstr("error, all samples: training 11.8 % -> 6.1 %"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("\nwhere  velocity")));
  EXPECT_THAT(outcome.out, HasSubstr("\nnext   "));
  EXPECT_THAT(outcome.out, Not(HasSubstr("wrote")));
  EXPECT_THAT(outcome.err, HasSubstr("4 parameters; "));
  EXPECT_THAT(outcome.err, HasSubstr("baseline 4 parameters; error 11.8 % train, 12.1 % validation\n"));
  EXPECT_THAT(outcome.err, HasSubstr("\nreplicates 400 replicates, "));
  EXPECT_THAT(outcome.err, HasSubstr("\nsearch   34 effects, "));
  EXPECT_THAT(outcome.err, HasSubstr("\nwrote  "));
}

TEST_F(DiagnoseCommand, WritesTheColumnsOfEffectsInsteadOfADiagnosis) {
  write_job(job_text + "[diagnose]\neffects = [\"spring\", \"stribeck\"]\n");
  std::filesystem::path const columns = folder / "C.h5";
  Outcome const outcome = run({"--columns", columns.string()});
  EXPECT_EQ(outcome.code, ExitCode::ok) << outcome.err;
  EXPECT_EQ(diagnosed, 0);
  EXPECT_FALSE(std::filesystem::exists(result()));
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, HasSubstr("no diagnosis was made"));
  ResultReader const reader(columns);
  auto const names = reader.attribute<std::vector<std::string>>("/columns", "effects");
  EXPECT_THAT(names, ::testing::IsSubsetOf({"spring", "stribeck"}));
  ASSERT_THAT(names, Not(IsEmpty()));
  std::size_t const rows = reader.numbers("/columns/train/torque").shape.at(0);
  EXPECT_GT(rows, 100u);
  EXPECT_EQ(reader.numbers("/columns/train/regressor").shape, (h5::Shape{rows, 4}));
  for (auto const& name : names)
    EXPECT_EQ(reader.numbers("/columns/train/candidates/" + name).shape, (h5::Shape{rows, 1})) << name;

  EXPECT_THROW(read_summary(columns), Error);  // `show` and `report` say what it is
  EXPECT_EQ(run({"--columns", columns.string()}).code, ExitCode::exists);
}

TEST_F(DiagnoseCommand, IsMadeByOneShardAlone) {
  Outcome const other = run({"--shard", "1/2"});
  EXPECT_EQ(other.code, ExitCode::ok);
  EXPECT_THAT(other.err, HasSubstr("a diagnosis is not divided, --shard 0/2 makes it"));
  EXPECT_EQ(diagnosed, 0);
  EXPECT_FALSE(std::filesystem::exists(result()));
  EXPECT_EQ(run({"--shard", "0/2"}).code, ExitCode::ok);
  EXPECT_EQ(diagnosed, 1);
}

TEST_F(DiagnoseCommand, EndsWithTheCodeOfItsVerdictWhereSomebodyAsks) {
  // the numbers themselves: scripts depend on them
  for (auto const& [diagnosis, code] : std::vector<std::pair<Diagnosis, int>>{{example::invented_none(), 0},
                                                                              {example::invented_diagnosis(), 10},
                                                                              {example::invented_partly(), 12},
                                                                              {example::invented_unexplained(), 13},
                                                                              {example::invented_insufficient(), 65},
                                                                              {example::invented_data_fault(), 65}}) {
    std::filesystem::remove(result());
    found = diagnosis;
    EXPECT_EQ(static_cast<int>(run({"--exit-code"}).code), code) << word(diagnosis.verdict);
    EXPECT_EQ(static_cast<int>(run({"--exit-code"}).code), code) << "kept";
    EXPECT_EQ(run().code, ExitCode::ok);
    EXPECT_EQ(static_cast<int>(show({"--exit-code"}).code), code);
    EXPECT_EQ(show().code, ExitCode::ok);
  }
  EXPECT_EQ(static_cast<int>(code_of(Verdict::one_of_class)), 11);
}

TEST_F(DiagnoseCommand, EveryVerdictHasACodeThatTheHelpPageExplains) {
  for (auto const verdict : {Verdict::none, Verdict::named, Verdict::one_of_class, Verdict::partly,
                             Verdict::unexplained, Verdict::insufficient, Verdict::data_fault}) {
    auto const explained = verdict_codes();
    EXPECT_TRUE(std::any_of(explained.begin(), explained.end(), [&](auto const& one) {
      return one.code == code_of(verdict);
    })) << word(verdict);
  }
}

TEST_F(DiagnoseCommand, SucceedsWhateverTheVerdict) {
  for (auto const& diagnosis : {example::invented_partly(), example::invented_none(), example::invented_unexplained(),
                                example::invented_insufficient(), example::invented_data_fault()}) {
    found = diagnosis;
    std::filesystem::remove(result());
    EXPECT_EQ(run().code, ExitCode::ok) << word(diagnosis.verdict);
  }
}

TEST_F(DiagnoseCommand, QuietLeavesTheVerdictAlone) {
  Outcome const outcome = run({"--quiet"});
  EXPECT_THAT(outcome.out, HasSubstr("NAMED  Stribeck friction"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("where")));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(DiagnoseCommand, JsonOnStdoutIsThatDocumentOnly) {
  Outcome const outcome = run({"--json", "-"});
  EXPECT_EQ(outcome.out, diagnosis_json(found));
}

TEST_F(DiagnoseCommand, JsonFileIsWrittenAndNamed) {
  std::string const file = (folder / "V.json").string();
  Outcome const outcome = run({"--json", file});
  EXPECT_EQ(test::bytes_of(file), diagnosis_json(found));
  EXPECT_THAT(outcome.err, HasSubstr("V.json"));
}

TEST_F(DiagnoseCommand, AFinishedJobIsShownAgainFromItsFile) {
  Outcome const first = run({"--json", "-"});
  Outcome const again = run({"--json", "-"});
  EXPECT_EQ(diagnosed, 1);
  EXPECT_EQ(again.out, first.out);
  EXPECT_THAT(again.err, HasSubstr("already diagnosed: nothing runs again"));
  EXPECT_THAT(again.err, HasSubstr("to diagnose anew"));
  EXPECT_THAT(again.err, HasSubstr("\nkept   "));
  EXPECT_THAT(run({"--all"}).out, Not(HasSubstr("more below these")));
}

TEST_F(DiagnoseCommand, AnotherJobDoesNotOverwriteTheFile) {
  run();
  write_job(job_text + "friction_is_other = 1\n");
  EXPECT_NE(run().code, ExitCode::ok);  // 78: the job is wrong
  write_job("# another job\n" + job_text);
  Outcome const outcome = run();
  EXPECT_EQ(outcome.code, ExitCode::exists);
  EXPECT_EQ(diagnosed, 1);
}

TEST_F(DiagnoseCommand, DoesNotTakeTheRunsOfAJobForItsDiagnosis) {
  write_job(job_text + "[[estimator]]\nname = \"ols\"\n");
  IdentifyOptions options;
  options.threads = choose_threads(1);
  options.output = result();
  identify(Experiment::load(folder / "job.toml"), options, ProgressSink{});
  Outcome const outcome = run();
  EXPECT_EQ(outcome.code, ExitCode::exists);
  EXPECT_THAT(outcome.err, HasSubstr("holds the runs of this job, not its diagnosis"));
  EXPECT_EQ(show().code, ExitCode::ok);
  EXPECT_EQ(show({"--exit-code"}).code, ExitCode::usage);
  EXPECT_THAT(show({"--exit-code"}).err, HasSubstr("there is no verdict"));
}

TEST_F(DiagnoseCommand, TheFileHoldsJobDataOptionsAndProvenance) {
  run();
  ResultReader const reader(result());
  EXPECT_EQ(reader.verify(), reader.content_sha256());
  EXPECT_EQ(reader.texts("/job/text"), std::vector<std::string>{job_text});
  EXPECT_EQ(reader.attribute<std::int64_t>("/diagnosis/options", "twins"), 200);
  EXPECT_TRUE(reader.exists("/data/train/torque"));
  EXPECT_FALSE(reader.exists("/runs"));
  EXPECT_EQ(reader.attribute<std::string>("/provenance", "numerics_sha256").size(), 64u);
  EXPECT_FALSE(reader.find_attribute<double>("/provenance", "seconds")) << "equal diagnoses are equal files";
  EXPECT_GT(read_summary(result()).provenance.seconds, 0.0);
  EXPECT_EQ(read_verdict_json(reader), diagnosis_json(found));
}

TEST_F(DiagnoseCommand, NothingIsLeftBehindWhenTheWorkFails) {
  CLI::App app("", "torquescope");
  ChosenCommand chosen;
  add_diagnose(app, chosen, [](auto const& experiment, auto const& request, auto const&) {
    return diagnose_into_file(
        experiment, request, []() -> Diagnosis { throw Error(Problem{.code = ExitCode::stopped, .what = "stopped"}); });
  });
  std::vector<std::string> reversed{"--quiet", result().string(), "--out", (folder / "job.toml").string(), "diagnose"};
  app.parse(reversed);
  EXPECT_THROW(chosen.work(Session(chosen.session)), Error);
  EXPECT_EQ(folder.n_files(), 1u);  // the job alone
}

TEST_F(DiagnoseCommand, ShowPrintsTheSamePageFromTheFile) {
  Outcome const made = run();
  std::string const page = show().out;
  EXPECT_THAT(page, StartsWith(made.out));
  EXPECT_THAT(page, HasSubstr("model of joint 1"));
  EXPECT_THAT(page, HasSubstr("\nmade\n"));
}

TEST_F(DiagnoseCommand, ShowsWhatExplainsAPartWithItsParametersAndErrors) {
  found = example::invented_partly();
  Outcome const made = run({"--progress", "none"});
  EXPECT_THAT(made.out, HasSubstr("PARTLY EXPLAINED  71 % of the mismatch by Stribeck"));
  std::string const page = show().out;
  EXPECT_THAT(page, StartsWith(made.out));
  for (char const* words : {"stribeck_speed", "error, validation", "7.8 %", "explained, held-out rows", "71 %"})
    EXPECT_THAT(page, HasSubstr(words));
}

}  // namespace diagnose_command_test
}  // namespace torquescope
