// start_from: searches begin at the best estimate of a result, as far as that has parameters of the same names.

#include "engine/experiment/start_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/store/result_reader.hpp"
#include "support/simulated_job.hpp"

namespace torquescope {
namespace start_point_test {

namespace fs = std::filesystem;

std::string job_of(std::string const& estimators, std::string const& terms, std::string const& bound = "[-1, 1]") {
  return "[experiment]\nname = \"start\"\nruns = 3\n[model]\nterms = [" + terms + "]\n[filter]\nedge_s = 0\n" +
         "[model.bounds]\nevery = [-1, 1]\ninertia = " + bound + "\n" + test::simulated_joint +
         "[simulate.noise]\ntorque_std = 0.01\n" + estimators;
}

std::string const all = R"("inertia", "viscous", "coulomb", "offset")", two = R"("inertia", "coulomb")";
std::string const ols = "[[estimator]]\nname = \"ols\"\n";
std::string searches(fs::path const& from, std::string const& generations = "5") {
  std::string const more =
      "generations = " + generations + "\nfitness = \"direct\"\nstart_from = \"" + from.string() + "\"\n";
  return "[[estimator]]\nname = \"de\"\n" + more + "[[estimator]]\nname = \"cmaes\"\nsigma = 1e-6\n" + more;
}

fs::path identified(std::string const& job, fs::path const& output, fs::path const& continued = {}) {
  IdentifyOptions options;
  options.threads = {1, "test"};
  options.output = output;
  options.continued = continued;
  identify(test::load_job(job), options, {});
  return output;
}

std::vector<double> numbers(fs::path const& result, std::string const& path) {
  return ResultReader(result).numbers(path).values;
}

TEST(StartFrom, TheBestEstimateIsTheFirstMemberAndTheFirstMean) {
  test::TemporaryFolder const folder;
  fs::path const old = identified(job_of(ols, two), folder / "old.h5");
  auto const best = numbers(old, "/runs/ols/parameters");  // inertia, coulomb
  fs::path const warm = identified(job_of(searches(old), all), folder / "warm.h5");
  std::size_t const members = ResultReader(warm).shape("/runs/de/population")[2];
  auto const population = numbers(warm, "/runs/de/population");
  for (std::size_t run = 0; run < 3; ++run) {
    double const* const first = population.data() + run * 6 * members * 4;
    EXPECT_EQ(first[0], best[0]);
    EXPECT_EQ(first[2], best[1]);
    for (std::size_t i = 1; i < members; ++i) EXPECT_NE(first[i * 4], best[0]);
  }
  EXPECT_NE(population[1], population[6 * members * 4 + 1]) << "what the result does not know is drawn, run by run";
  auto const candidates = numbers(warm, "/runs/cmaes/population");
  EXPECT_NEAR(candidates[0], best[0], 1e-4);
  EXPECT_NEAR(candidates[2], best[1], 1e-4);
  EXPECT_TRUE(std::isnan(numbers(warm, "/runs/de/F")[0]));
  auto const start = ResultReader(warm).attribute<std::vector<double>>("/runs/de", "start");
  EXPECT_EQ(start[0], best[0]);
  EXPECT_TRUE(std::isnan(start[1]));
}

TEST(StartFrom, ABetterOneThanTheBoxAllowsIsMovedIntoItAndTold) {
  test::TemporaryFolder const folder;
  fs::path const old = identified(job_of(ols, all), folder / "old.h5");
  auto const experiment = test::load_job(job_of(searches(old), all, "[-1, 0.1]"));
  std::string told;
  for (auto const& line : experiment.remarks()) told += line + "\n";
  EXPECT_NE(told.find("de starts at " + old.string() + " (ols): inertia 0.5"), std::string::npos) << told;
  EXPECT_NE(told.find("; moved into the box: inertia\n"), std::string::npos) << told;
  fs::path const warm = identified(job_of(searches(old), all, "[-1, 0.1]"), folder / "warm.h5");
  EXPECT_EQ(numbers(warm, "/runs/de/population")[0], 0.1);
  EXPECT_LE(numbers(warm, "/runs/cmaes/population")[0], 0.1);
}

TEST(StartFrom, IsPartOfWhatAResultWasMadeFrom) {
  test::TemporaryFolder const folder;
  fs::path const old = identified(job_of(ols, all), folder / "old.h5");
  std::string const first = test::load_job(job_of(searches(old), all)).inputs_sha256();
  fs::path const warm = identified(job_of(searches(old), all), folder / "warm.h5");
  // a longer search that goes on is one long search here too
  std::string const longer = job_of(searches(old, "9"), all);
  EXPECT_TRUE(test::bytes_of(identified(longer, folder / "on.h5", warm)) ==
              test::bytes_of(identified(longer, folder / "whole.h5")));
  fs::remove(old);
  identified(job_of(ols, two), old);
  EXPECT_NE(test::load_job(job_of(searches(old), all)).inputs_sha256(), first);
  EXPECT_THROW(identified(longer, folder / "other.h5", warm), Error);
  EXPECT_FALSE(fs::exists(folder / "other.h5"));
}

void expect_refused(std::string const& job, ExitCode code, std::string const& words) {
  try {
    test::load_job(job);
    FAIL() << words;
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_NE(error.problems().front().what.find(words), std::string::npos) << error.problems().front().what;
  }
}

TEST(StartFrom, RefusesWhatItCannotStartFrom) {
  test::TemporaryFolder const folder;
  expect_refused(job_of(searches(folder / "none.h5"), all), ExitCode::no_input, "none.h5");
  expect_refused(job_of(searches(folder.write("text.h5", "no result")), all), ExitCode::bad_data, "text.h5");
  fs::path const old = identified(job_of(ols, two), folder / "old.h5");
  std::string other = job_of(searches(old), R"("viscous", "offset")");
  other.replace(other.find("inertia = [-1, 1]\n"), 18, "");
  expect_refused(other, ExitCode::bad_job, "no parameter of this model");
  expect_refused(job_of("[[estimator]]\nname = \"ols\"\nstart_from = \"old.h5\"\n", all), ExitCode::bad_job,
                 "start_from");
}

}  // namespace start_point_test
}  // namespace torquescope
