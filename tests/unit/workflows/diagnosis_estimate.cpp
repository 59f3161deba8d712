// The estimate of a diagnosis is linear in what it is made of, and near what was measured.
//
// Measured on one core, one effect found, 48 replicates, as long a validation recording. The first three: [simulate] of
// jobs/concealed_stribeck.toml at 500 Hz, parallel cut-offs of 15 and 60 Hz; the others: a joint like it at 1 kHz.

#include "engine/experiment/diagnosis_estimate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/experiment/experiment_parts.hpp"
#include "support/simulated_job.hpp"

namespace torquescope {
namespace diagnosis_estimate_test {

using ::testing::HasSubstr;

struct Measured {
  double samples, rows, cpu_s, megabytes;
};
constexpr Measured table[] = {{1e4, 768.0, 11.8, 54.0},
                              {1e4, 3072.0, 87.0, 174.0},
                              {5e4, 3840.0, 256.0, 190.0},
                              {6e4, 2304.0, 32.5, 191.0},
                              {3e5, 11520.0, 224.0, 400.0}};

TEST(DiagnosisEstimate, IsWithinAFactorOfThreeOfWhatWasMeasured) {
  for (auto const& one : table) {
    auto const estimate = estimate_diagnosis({one.samples, one.rows, 48.0, one.samples, 1.0, 6e4}, 1);
    EXPECT_GT(estimate.seconds, one.cpu_s / 3.0) << one.samples << " samples, " << one.rows << " rows";
    EXPECT_LT(estimate.seconds, one.cpu_s * 3.0) << one.samples << " samples, " << one.rows << " rows";
    EXPECT_GT(estimate.bytes, one.megabytes * 1e6 / 3.0) << one.samples << " samples, " << one.rows << " rows";
    EXPECT_LT(estimate.bytes, one.megabytes * 1e6 * 3.0) << one.samples << " samples, " << one.rows << " rows";
  }
}

TEST(DiagnosisEstimate, GrowsWithRowsTimesReplicates) {
  DiagnosisSize const few{1e5, 1e4, 200.0, 0.0}, many{1e5, 1e5, 200.0, 0.0}, none{1e5, 0.0, 200.0, 0.0};
  double const fixed = estimate_diagnosis(none, 1).bytes;
  EXPECT_NEAR(estimate_diagnosis(many, 1).bytes - fixed, 10.0 * (estimate_diagnosis(few, 1).bytes - fixed), 1.0);
  EXPECT_LT(estimate_diagnosis(many, 4).seconds, estimate_diagnosis(many, 1).seconds);
}

// a joint at 500 Hz
Experiment of_seconds(double duration_s, std::string const& parallel) {
  std::string const simulate =
      "[simulate]\nmode = \"inverse_dynamics\"\nrate_hz = 500\nduration_s = " + std::to_string(duration_s) +
      "\nvalidate = false\n[simulate.plant]\ninertia = 0.5\nviscous = 0.2\ncoulomb = 0.1\n";
  return test::load_job(
      simulate + test::joint_model + "[diagnose]\ntwins = 200\n[filter]\ncutoff_hz = 200\n" + parallel,
      Experiment::Purpose::diagnose);
}

TEST(DiagnosisEstimate, CountsTheRowsThatTheCutOffLeaves) {
  EXPECT_NEAR(diagnosis_size(of_seconds(100.0, "parallel_cutoff_hz = 15\n").parts()).rows, 3840.0, 1.0);
  EXPECT_EQ(diagnosis_size(of_seconds(100.0, "parallel_cutoff_hz = 15\n").parts()).replicates, 48.0);
  EXPECT_FALSE(many_rows_warning(of_seconds(100.0, "parallel_cutoff_hz = 15\n").parts()));
  EXPECT_THAT(many_rows_warning(of_seconds(200.0, "parallel_cutoff_hz = 100\n").parts()).value_or(""),
              HasSubstr("a lower parallel_cutoff_hz"));

  // a job that is only checked has let go of its recording by then
  std::string const checked_job = test::simulated_joint + test::joint_model + "[[estimator]]\nname = \"ols\"\n";
  Experiment const checked = test::load_job(checked_job, Experiment::Purpose::check);
  EXPECT_EQ(diagnosis_size(checked.parts()).samples, 1000.0);
}

}  // namespace diagnosis_estimate_test
}  // namespace torquescope
