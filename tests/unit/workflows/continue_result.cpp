// A search that ended and goes on under a larger budget ends in the very file of a search that had that budget from the
// beginning; whatever would not, is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "engine/base/error.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/workflows/workflows.hpp"
#include "support/simulated_job.hpp"

namespace torquescope {
namespace continue_result_test {

namespace fs = std::filesystem;

std::string const data = test::joint_model + "[filter]\nedge_s = 0\n[model.bounds]\nevery = [-1, 1]\n" +
                         test::simulated_joint + "[simulate.noise]\ntorque_std = 0.01\n";

std::string job_of(std::string const& estimators, int runs = 3) {
  return data + "[experiment]\nname = \"longer\"\nruns = " + std::to_string(runs) +
         "\n[[estimator]]\nname = \"ols\"\n" + estimators;
}

// every method that can go on
std::string methods(std::string const& rules) {
  return "[[estimator]]\nname = \"de\"\npopulation = 8\n" + rules + "[[estimator]]\nname = \"fade\"\npopulation = 8\n" +
         rules + "[[estimator]]\nname = \"lshade\"\nreduction = \"none\"\npopulation = 9\n" + rules +
         "[[estimator]]\nname = \"cmaes\"\n" + rules;
}

std::string de(std::string const& rules) { return "[[estimator]]\nname = \"de\"\npopulation = 8\n" + rules; }

fs::path identified(std::string const& job, fs::path const& output, fs::path const& continued = {}, int threads = 1) {
  IdentifyOptions options;
  options.threads = {threads, "test"};
  options.output = output;
  options.continued = continued;
  identify(test::load_job(job), options, {});
  return output;
}

// the file of the longer job, made in one go and made by going on, is one
void expect_same_file(std::string const& shorter, std::string const& longer) {
  test::TemporaryFolder const folder;
  std::string const whole = test::bytes_of(identified(longer, folder / "whole.h5"));
  fs::path const before = identified(shorter, folder / "before.h5");
  std::string const untouched = test::bytes_of(before);
  EXPECT_FALSE(untouched == whole);
  EXPECT_TRUE(test::bytes_of(identified(longer, folder / "after.h5", before, 3)) == whole) << "3 threads";
  EXPECT_TRUE(test::bytes_of(before) == untouched);
  EXPECT_TRUE(test::bytes_of(identified(longer, before, before)) == whole) << "under its own name";
}

TEST(Continue, OfMoreGenerationsIsTheFileOfOneLongSearch) {
  expect_same_file(job_of(methods("generations = 30\n")), job_of(methods("generations = 60\n")));
}

TEST(Continue, BehindABudgetThatCutItsLastBatchIsTheFileOfOneLongSearch) {
  // neither number is whole batches of any of them; 5 does not even hold the initial population
  for (std::string const few : {"5", "150"})
    expect_same_file(job_of(methods("generations = 60\nfitness = \"direct\"\nevaluations = " + few + "\n")),
                     job_of(methods("generations = 60\nfitness = \"direct\"\nevaluations = 301\n")));
}

TEST(Continue, OfRunsThatEndedByOtherRulesIsTheFileOfOneLongSearch) {
  expect_same_file(job_of(methods("generations = 60\nstagnation = 3\n")),
                   job_of(methods("generations = 70\nstagnation = 9\n")));
  // some runs had reached what ends them still
  expect_same_file(job_of(methods("generations = 20\ntarget = 1e-3\n")),
                   job_of(methods("generations = 90\ntarget = 1e-3\n")));
}

TEST(Continue, TakesMoreRunsOtherNamesAndAnotherEstimator) {
  std::string const more = "[[estimator]]\nname = \"fade\"\npopulation = 8\ngenerations = 12\n";
  expect_same_file(job_of(de("generations = 15\n")), job_of(more + de("generations = 25\n"), 5));
}

TEST(Continue, TwiceInARowIsOnce) {
  test::TemporaryFolder const folder;
  fs::path const result = folder / "r.h5";
  identified(job_of(methods("generations = 10\n")), result);
  identified(job_of(methods("generations = 20\n")), result, result);
  identified(job_of(methods("generations = 35\n")), result, result);
  EXPECT_TRUE(test::bytes_of(result) ==
              test::bytes_of(identified(job_of(methods("generations = 35\n")), folder / "whole.h5")));
}

TEST(Continue, StoppedGoesOnFromSegmentsWithoutTheEarlierResult) {
  test::TemporaryFolder const folder;
  std::string const longer = job_of(methods("generations = 60\n"));
  std::string const whole = test::bytes_of(identified(longer, folder / "whole.h5"));
  IdentifyOptions options;
  options.threads = {2, "test"};
  options.output = folder / "stopped.h5";
  options.continued = identified(job_of(methods("generations = 20\n")), folder / "before.h5");
  options.segment_seconds = 0.001;
  std::atomic<int> polled{0};
  options.stop_requested = [&] { return ++polled > 150; };
  try {
    identify(test::load_job(longer), options, {});
    FAIL() << "it was not stopped";
  } catch (Error const& error) {
    ASSERT_EQ(error.code(), ExitCode::stopped) << error.what();
  }
  EXPECT_TRUE(test::bytes_of(identified(longer, options.output)) == whole);
}

TEST(Continue, InShardsMergesToTheSameFile) {
  test::TemporaryFolder const folder;
  std::string const longer = job_of(methods("generations = 40\n"));
  std::string const whole = test::bytes_of(identified(longer, folder / "whole.h5"));
  IdentifyOptions options;
  options.threads = {1, "test"};
  options.output = folder / "merged.h5";
  options.continued = identified(job_of(methods("generations = 20\n")), folder / "before.h5");
  for (std::size_t index : {0u, 1u}) {
    options.shard = {index, 2, "test"};
    run_shard(test::load_job(longer), options, {});
  }
  options.shard = {};
  options.continued.clear();
  merge(test::load_job(longer), options, Completeness::whole, {});
  EXPECT_TRUE(test::bytes_of(options.output) == whole);
}

// every sentence of the refusal, one after the other
std::string refusal(std::string const& shorter, std::string const& longer) {
  test::TemporaryFolder const folder;
  fs::path const before = identified(shorter, folder / "before.h5");
  std::string const untouched = test::bytes_of(before);
  std::string words;
  try {
    identified(longer, folder / "after.h5", before);
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_job);
    for (auto const& problem : error.problems()) {
      words += problem.what + "\n";
      for (auto const& note : problem.notes) words += note + "\n";
      words += problem.help + "\n";
    }
  }
  EXPECT_FALSE(fs::exists(folder / "after.h5"));
  EXPECT_TRUE(test::bytes_of(before) == untouched);
  return words;
}

void expect_words(std::string const& said, std::vector<std::string> const& words) {
  for (auto const& word : words) EXPECT_NE(said.find(word), std::string::npos) << word << "\nis not in\n" << said;
}

TEST(Continue, RefusesAnotherSearchAndSaysWhatDiffers) {
  std::string const before = job_of(de("generations = 10\n"));
  expect_words(refusal(before, job_of(de("generations = 20\nCR = 0.5\n"))), {"de: estimator.CR stands in the job now"});
  auto changed = [&](std::string const& from, std::string const& to) {
    std::string job = job_of(de("generations = 20\n"));
    job.replace(job.find(from), from.size(), to);
    return refusal(before, job);
  };
  expect_words(changed("every = [-1, 1]", "every = [-2, 1]"), {"model.bounds.every: [-1, 1] then, [-2, 1] now"});
  expect_words(changed("runs = 3", "seed = 9"), {"experiment.seed stands in the job now alone"});
  expect_words(changed("torque_std = 0.01", "torque_std = 0.02"),
               {"simulate.noise.torque_std: 0.01 then, 0.02 now", "holds other samples (its sha256 differs)"});
  expect_words(changed("name = \"de\"", "name = \"de\"\nlabel = \"mine\""), {"no label is in both"});
}

TEST(Continue, RefusesABudgetThatASearchHadPlannedBy) {
  std::string const lshade = "[[estimator]]\nname = \"lshade\"\npopulation = 9\n";
  expect_words(refusal(job_of(lshade + "generations = 10\n"), job_of(lshade + "generations = 20\n")),
               {"lshade spends its budget by a plan", "give lshade the limits it had"});
  expect_words(
      refusal(job_of(lshade + "generations = 10\n"), job_of(lshade + "generations = 10\nevaluations = 9999\n")),
      {"lshade spends its budget by a plan"});
  // with the limits it had it goes on, here to another target
  expect_same_file(job_of(lshade + "generations = 40\ntarget = 1e-2\n"),
                   job_of(lshade + "generations = 40\ntarget = 1e-4\n"));
}

TEST(Continue, RefusesStricterRules) {
  std::string const before = job_of(de("generations = 20\nstagnation = 9\n"));
  expect_words(refusal(before, job_of(de("generations = 19\nstagnation = 9\n"))), {"generations of de is stricter"});
  expect_words(refusal(before, job_of(de("generations = 30\nstagnation = 8\n"))), {"stagnation of de is stricter"});
  expect_words(refusal(before, job_of(de("generations = 30\nstagnation = 9\ntarget = 1e-3\nevaluations = 99\n"))),
               {"target of de is stricter", "evaluations of de is stricter"});
}

TEST(Continue, RefusesFitnessMadeInAnotherWayAndTakesTheOldOne) {
  // 24 evaluations do not repay statistics, 240 do
  std::string const few = job_of(de("generations = 2\n"), 1);
  expect_words(refusal(few, job_of(de("generations = 60\n"), 1)),
               {"would be made by \"gram\" now, and was by \"direct\"", "write fitness = \"direct\" for de"});
  expect_same_file(few, job_of(de("generations = 60\nfitness = \"direct\"\n"), 1));
}

TEST(Continue, RefusesAResultWithoutStates) {
  std::string const lean = job_of(de("generations = 10\n")) + "[output]\npopulations = false\n";
  expect_words(refusal(lean, job_of(de("generations = 20\n"))), {"keeps no states of de", "populations = true"});
  // the other way round there are
  expect_same_file(job_of(de("generations = 10\n")),
                   job_of(de("generations = 20\n")) + "[output]\npopulations = false\n");
}

}  // namespace continue_result_test
}  // namespace torquescope
