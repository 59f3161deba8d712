// The scripts of `submit`: jobs/slurm/*.sbatch with every line filled in, valid for bash whatever the names are.

#include "engine/app/commands/slurm_scripts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/base/error.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace slurm_scripts_test {

using ::testing::HasSubstr;
using ::testing::Not;

SlurmPlan const plan{"/opt/torque scope", "it's a job.toml", "out/r.h5", "lab", 8, 4, "01:30:00", "long", 2.5};

TEST(SlurmScripts, SayWhatWasAskedFor) {
  std::string const script = array_script(plan);
  for (auto const* line :
       {"#!/bin/bash\n", "\n#SBATCH --array=0-7\n", "\n#SBATCH --cpus-per-task=4\n", "\n#SBATCH --time=01:30:00\n",
        "\n#SBATCH --partition=long\n", "\n#SBATCH --requeue\n", "\n#SBATCH --open-mode=append\n",
        "\n#SBATCH --signal=B:USR1@120\n", "\njob='it'\\''s a job.toml'\n", "\nresult='out/r.h5'\n", "\nshards=8\n",
        "\ncommand=run", "\n#SBATCH --job-name=\"lab\"\n", "\n#SBATCH --output=\"out/r.h5.shard-%a.log\"\n",
        "\nsave_every=2.5\n", "scontrol requeue"})
    EXPECT_THAT(script, HasSubstr(line));
  EXPECT_THAT(merge_script(plan), HasSubstr("merge \"$job\" --out \"$result\""));
  EXPECT_THAT(array_script({"t", "j", "r", "n", 2, 1}), Not(HasSubstr("--partition")));
}

TEST(SlurmScripts, AskForAsMuchTimeAsMergingTakes) {
  SlurmPlan large = plan;
  EXPECT_THAT(merge_script(large), HasSubstr("\n#SBATCH --time=00:30:00\n"));
  large.result_bytes = std::uintmax_t{140'000'000'000};  // of ten million small runs
  EXPECT_THAT(merge_script(large), HasSubstr("\n#SBATCH --time=0-01:18:00\n"));
  EXPECT_EQ(merge_time(std::uintmax_t{4} << 40), "1-16:44:00");
  EXPECT_EQ(merge_time(0), "");
}

TEST(SlurmScripts, AreValidForBash) {
  test::TemporaryFolder const folder;
  for (auto const& text : {array_script(plan), merge_script(plan)}) {
    auto const file = folder.write("script.sh", text);
    EXPECT_EQ(std::system(("bash -n '" + file.string() + "'").c_str()), 0);
  }
}

TEST(SlurmScripts, OfADiagnosisSayIt) {
  SlurmPlan diagnosis = plan;
  diagnosis.diagnoses = true;
  EXPECT_THAT(array_script(diagnosis), HasSubstr("\ncommand=diagnose\n"));
}

// what sbatch unquotes (its manual: quotes and backslashes in #SBATCH lines, % in names of files)
TEST(SbatchWord, KeepsBlanksQuotesPercentAndLettersOfAnyLanguage) {
  EXPECT_EQ(sbatch_word("a b # \"c\" it's \\ \u00fc"), "\"a b # \\\"c\\\" it's \\\\ \u00fc\"");
  EXPECT_EQ(sbatch_pattern("100%a \u00fc", ".shard-%a.log"), "\"100%%a \u00fc.shard-%a.log\"");
}

TEST(CheckPlan, RefusesWhatNoScriptCanCarry) {
  EXPECT_NO_THROW(check_plan(plan));
  for (auto SlurmPlan::*word : {&SlurmPlan::program, &SlurmPlan::job, &SlurmPlan::result, &SlurmPlan::name})
    for (auto const* text : {"a\nresult=b", "a\rb", "a\x7f"}) {
      SlurmPlan hostile = plan;
      hostile.*word = text;
      EXPECT_THROW(check_plan(hostile), Error) << text;
    }
  SlurmPlan backslash = plan;
  backslash.result = "a\\b.h5";
  EXPECT_THROW(check_plan(backslash), Error);
}

// the words a shell makes of it
TEST(ShellWord, IsOneWordWhateverItHolds) {
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("$(rm -r x); 'y'"), "'$(rm -r x); '\\''y'\\'''");
}

}  // namespace slurm_scripts_test
}  // namespace torquescope
