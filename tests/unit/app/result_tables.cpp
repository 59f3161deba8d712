#include "engine/app/result/result_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/app/result/paper_tables.hpp"
#include "engine/app/result/result_json.hpp"
#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {
namespace result_tables_test {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

EstimatorSummary estimator(std::string const& name, std::string const& kind, std::int64_t runs) {
  EstimatorSummary summary;
  summary.name = name;
  summary.kind = kind;
  summary.runs = runs;
  summary.parameters = summary.parameters_mean = {0.0036, 0.0164, 0.0089, -0.2582};
  if (kind == "ols") summary.standard_error = {0.0017, 0.0089, 0.014, 0.014};
  summary.mse_median = summary.mse_mean = 0.0925912345678901;
  summary.gap_median = kind == "ols" ? 0.0 : 8.3e-12;
  summary.relerr_median = 0.0721;
  summary.validation_relerr_median = nan;
  summary.residual_std_median = 0.3043;
  summary.evaluations = runs * 3000;
  summary.stop_reasons = {{"generations", runs}};
  return summary;
}

ResultSummary crs_a465() {
  ResultSummary summary;
  summary.file = "crs_a465_joint.h5";
  summary.name = "crs_a465_joint";
  summary.study = "crs_a465";
  summary.joint = "revolute";
  summary.names = {"inertia", "viscous", "coulomb_positive", "coulomb_negative"};
  summary.units = {"kg m2", "N m s/rad", "N m", "N m"};
  summary.truth = {0.0036, 0.0164, 0.0089, -0.2582};
  summary.estimators = {estimator("ols", "ols", 1), estimator("de", "de", 30), estimator("fade", "fade", 30)};
  summary.provenance.seconds = 4.2;
  return summary;
}

TEST(ResultTable, IsTheOneOfTheSpecification) {
  EXPECT_EQ(result_table(crs_a465(), Ink()),
            "crs_a465_joint                      truth        OLS         DE       FADE\n"
            "  inertia           kg m2          0.0036     0.0036     0.0036     0.0036\n"
            "  viscous           N m s/rad      0.0164     0.0164     0.0164     0.0164\n"
            "  coulomb_positive  N m            0.0089     0.0089     0.0089     0.0089\n"
            "  coulomb_negative  N m           -0.2582    -0.2582    -0.2582    -0.2582\n"
            "  MSE               (N m)2                   0.09259    0.09259    0.09259\n"
            "  gap to OLS, median of 30                                8e-12      8e-12\n"
            "  OLS standard error: inertia 0.0017, viscous 0.0089, coulomb_positive 0.014,\n"
            "                      coulomb_negative 0.014\n"
            "61 runs, 183 000 evaluations, 4.2 s\n");
}

TEST(ResultTable, HasNoTruthColumnForRealData) {
  ResultSummary summary = crs_a465();
  summary.truth.assign(4, nan);
  EXPECT_THAT(result_table(summary, Ink()), Not(HasSubstr("truth")));
}

TEST(ResultTable, ShowsValidationErrorsOnlyWhenThereIsValidationData) {
  ResultSummary summary = crs_a465();
  EXPECT_THAT(result_table(summary, Ink()), Not(HasSubstr("validation")));
  summary.has_validation = true;
  for (auto& each : summary.estimators) each.validation_relerr_median = 0.0733;
  EXPECT_THAT(result_table(summary, Ink()),
              HasSubstr("  error, validation %                           7.33       7.33       7.33\n"));
}

TEST(ResultTable, OfManyEstimatorsBreaksIntoBlocksOf80Columns) {
  ResultSummary summary = crs_a465();
  summary.estimators.push_back(estimator("a_label_somebody_made_up", "de", 30));
  for (int i = 0; i < 5; ++i) summary.estimators.push_back(estimator("fade_" + std::to_string(i), "fade", 30));
  std::string const text = result_table(summary, Ink());
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(columns_of(line), 80) << line;
  for (auto const& each : summary.estimators) EXPECT_THAT(text, HasSubstr(column_title(each)));
}

TEST(ResultTable, SaysTheSameInColour) {
  EXPECT_EQ(columns_of(result_table(crs_a465(), Ink(true))), columns_of(result_table(crs_a465(), Ink())));
}

TEST(EstimatorLines, CountWhyTheRunsEnded) {
  ResultSummary summary = crs_a465();
  summary.estimators[2].stop_reasons = {{"generations", 28}, {"target", 2}};
  EXPECT_THAT(estimator_lines(summary, Ink()), HasSubstr("FADE ended by 28 x generations, 2 x target"));
}

TEST(PaperTables, StandBesideOursOnlyInTheirStudy) {
  std::string const text = paper_tables(crs_a465(), Ink());
  EXPECT_THAT(text, HasSubstr("coulomb_negative  -0.2582  -0.2582  -0.3060  -0.2582  -0.2261  -0.2582"));
  EXPECT_THAT(text, HasSubstr("0.05233"));
  EXPECT_THAT(text, HasSubstr("nothing\n  has a smaller squared error than OLS"));
  ResultSummary other = crs_a465();
  other.study = "";
  EXPECT_EQ(paper_tables(other, Ink()), "");
}

TEST(ResultJson, KeepsEveryDigitAndSaysNullForNaN) {
  auto const document = nlohmann::json::parse(result_json(crs_a465()));
  EXPECT_EQ(document["schema"], 1);
  EXPECT_EQ(document["estimators"][1]["mse"]["median"].get<double>(), 0.0925912345678901);
  EXPECT_TRUE(document["estimators"][1]["validation_relerr"].is_null());
  EXPECT_TRUE(document["estimators"][1]["parameters"][0]["standard_error"].is_null());
  EXPECT_EQ(document["estimators"][0]["parameters"][3]["name"], "coulomb_negative");
  EXPECT_EQ(document["runs"], 61);
}

TEST(Quantile, LiesBetweenItsNeighbours) {
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 2.0, 3.0}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 2.0, 3.0, nan}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile({7.0}, 0.25), 7.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

}  // namespace result_tables_test
}  // namespace torquescope
