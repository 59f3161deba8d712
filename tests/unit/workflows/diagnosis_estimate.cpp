// The estimate of a diagnosis is linear in what it is made of, and near what was measured.
//
// Measured on two cores of a Xeon (Sapphire Rapids), one effect found, 200 replicates, [simulate] of
// jobs/concealed_stribeck.toml at 500 Hz with as long a validation recording:
//
//   samples     rows    CPU s   peak MB
//    10 000    1 000      6.4        53
//    10 000   10 000     11.4       137
//   100 000   10 000     60.4       346
//   100 000  100 000    202.6      1151
// 1 000 000  100 000    832.5      3791

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
constexpr Measured table[] = {{1e4, 1e3, 6.4, 53.0},
                              {1e4, 1e4, 11.4, 137.0},
                              {1e5, 1e4, 60.4, 346.0},
                              {1e5, 1e5, 202.6, 1151.0},
                              {1e6, 1e5, 832.5, 3791.0}};

TEST(DiagnosisEstimate, IsWithinAFactorOfThreeOfWhatWasMeasured) {
  for (auto const& one : table) {
    auto const estimate = estimate_diagnosis({one.samples, one.rows, 200.0, one.samples}, 1);
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

// seconds of a joint at 500 Hz, cut-offs far below
Experiment of_seconds(double duration_s, std::string const& decimation) {
  std::string const simulate =
      "[simulate]\nmode = \"inverse_dynamics\"\nrate_hz = 500\nduration_s = " + std::to_string(duration_s) +
      "\nvalidate = false\n[simulate.plant]\ninertia = 0.5\nviscous = 0.2\ncoulomb = 0.1\n";
  return test::load_job(simulate + test::joint_model + "[diagnose]\ntwins = 200\n[filter]\ncutoff_hz = 30\n" +
                            "parallel_cutoff_hz = 15\n" + decimation,
                        Experiment::Purpose::diagnose);
}

TEST(DiagnosisEstimate, ProposesDecimationWhereRowsAreManyAndTheCutOffLeavesRoom) {
  Experiment const undecimated = of_seconds(100.0, "");
  EXPECT_EQ(diagnosis_size(undecimated.parts()).rows, 5e4);
  auto const proposal = decimation_proposal(undecimated.parts(), 2);
  ASSERT_TRUE(proposal.has_value());
  EXPECT_THAT(*proposal, HasSubstr("decimate_to_hz = 50 in [filter] would keep 5000 of these rows"));

  // a job that is only checked has let go of its recording by then
  std::string const checked_job = test::simulated_joint + test::joint_model + "[[estimator]]\nname = \"ols\"\n";
  Experiment const checked = test::load_job(checked_job, Experiment::Purpose::check);
  EXPECT_EQ(diagnosis_size(checked.parts()).samples, 1000.0);
  EXPECT_FALSE(decimation_proposal(of_seconds(100.0, "decimate_to_hz = 50\n").parts(), 2)) << "done already";
  EXPECT_FALSE(decimation_proposal(of_seconds(20.0, "").parts(), 2)) << "few rows";
}

}  // namespace diagnosis_estimate_test
}  // namespace torquescope
