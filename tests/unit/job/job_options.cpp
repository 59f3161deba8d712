#include "engine/experiment/job/job_options.hpp"

#include <gtest/gtest.h>

#include "engine/experiment/job/job.hpp"

namespace torquescope {
namespace job_options_test {

template <class Options>
std::vector<Problem> applied(Job const& job, std::string const& section, Options& options) {
  std::vector<Problem> problems;
  Options::table().apply(*job.find(section), options, problems);
  return problems;
}

TEST(ExperimentOptions, AreReadFromTheirSection) {
  Job const job = parse_job("[experiment]\nname = \"lab\"\nseed = 7\nruns = 3\nstudy = \"crs_a465\"\n", "lab.toml");
  ExperimentOptions options;
  auto const problems = applied(job, "experiment", options);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(options.name, "lab");
  EXPECT_EQ(options.seed, 7);
  EXPECT_EQ(options.runs, 3);
  EXPECT_EQ(options.study, "crs_a465");
}

TEST(ExperimentOptions, RefuseARunlessExperimentAndAnUnknownStudy) {
  Job const job = parse_job("[experiment]\nruns = 0\nstudy = \"crs\"\nsed = 1\n", "lab.toml");
  ExperimentOptions options;
  auto const problems = applied(job, "experiment", options);
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[0].key, "experiment.runs");
  EXPECT_EQ(problems[1].key, "experiment.study");
  EXPECT_EQ(problems[2].caret_note, "did you mean \"seed\"?");
}

TEST(OutputOptions, KnowTwoCompressions) {
  Job const job = parse_job("[output]\nfile = \"r.h5\"\ncompression = \"zip\"\n", "lab.toml");
  OutputOptions options;
  auto const problems = applied(job, "output", options);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "output.compression");
  EXPECT_EQ(options.file, "r.h5");
}

TEST(OutputOptions, StoreSamplesUnlessTold) {
  EXPECT_TRUE(OutputOptions{}.samples);
  Job const job = parse_job("[output]\nsamples = false\n", "lab.toml");
  OutputOptions options;
  EXPECT_TRUE(applied(job, "output", options).empty());
  EXPECT_FALSE(options.samples);
}

}  // namespace job_options_test
}  // namespace torquescope
