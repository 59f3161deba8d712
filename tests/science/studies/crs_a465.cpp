// The seed's study as a whole job: OLS gives the paper's own row, and nothing can beat it on its own data.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "engine/store/result_reader.hpp"
#include "engine/workflows/workflows.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope {
namespace {

namespace fs = std::filesystem;

class CrsStudy : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    IdentifyOptions options;
    options.threads = {2, "test"};
    options.output = *folder_ / "R.h5";
    identify(Experiment::load(fs::path(TORQUESCOPE_SOURCE_DIR) / "jobs/crs_a465_joint.toml"), options, ProgressSink{});
  }
  static void TearDownTestSuite() { folder_.reset(); }
  ResultReader const result{*folder_ / "R.h5"};

 private:
  static inline std::unique_ptr<test::TemporaryFolder> folder_;
};

TEST_F(CrsStudy, OlsGivesTheRowOfTable3AndItsMse) {
  auto const parameters = result.numbers("/runs/ols/parameters").values;
  double const table_3[] = {0.0036, 0.0164, 0.0089, -0.2582};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(parameters[i], table_3[i], 1e-10 * std::fabs(table_3[i]));
  EXPECT_NEAR(result.attribute<double>("/runs/ols", "mse_median"), 0.09259, 1e-12);
}

TEST_F(CrsStudy, NoRunOfAnyEstimatorIsBelowTheLeastSquaresFloor) {
  double const floor = result.numbers("/runs/ols/mse").values.at(0);
  for (std::string const label : {"de", "fade"}) {
    for (double gap : result.numbers("/runs/" + label + "/gap").values) EXPECT_GE(gap, 0.0);
    // the subtraction of two MSEs rounds at some 1e-16 of either
    for (double mse : result.numbers("/runs/" + label + "/mse").values) EXPECT_GE(mse, floor * (1.0 - 1e-14));
  }
}

TEST_F(CrsStudy, DeReachesTheFloorWithinABillionthAndFadeIsSlower) {
  double const de = result.attribute<double>("/runs/de", "gap_median");
  double const fade = result.attribute<double>("/runs/fade", "gap_median");
  EXPECT_LT(de, 1e-9);
  EXPECT_LT(fade, 1e-4);
  EXPECT_LT(de, fade);
}

TEST_F(CrsStudy, ResidualSpreadNeverExceedsTheRootOfTheMse) {
  for (std::string const label : {"ols", "de", "fade"}) {
    auto const mse = result.numbers("/runs/" + label + "/mse").values;
    auto const spread = result.numbers("/runs/" + label + "/residual_std").values;
    for (std::size_t i = 0; i < mse.size(); ++i) EXPECT_LE(spread[i], std::sqrt(mse[i]) * (1 + 1e-12));
  }
}

TEST_F(CrsStudy, FAndCrDecayToTheFixedPointOfTheController) {
  // at PC = FC = 0 the centroid on [0, 2] gives F = .624, CR = .450
  auto const F = result.numbers("/runs/fade/F");
  auto const CR = result.numbers("/runs/fade/CR");
  std::size_t const generations = F.shape[1];
  for (std::size_t run = 0; run < F.shape[0]; ++run) {
    EXPECT_NEAR(F.values[run * generations + generations - 1], 0.624, 0.005);
    EXPECT_NEAR(CR.values[run * generations + generations - 1], 0.450, 0.005);
  }
}

}  // namespace
}  // namespace torquescope
