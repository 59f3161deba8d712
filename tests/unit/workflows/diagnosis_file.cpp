// A diagnosis survives the result file: everything that was written is read back, and a file that contradicts itself is
// refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/workflows/results/diagnosis_json.hpp"
#include "engine/workflows/results/diagnosis_reader.hpp"
#include "engine/workflows/results/diagnosis_writer.hpp"
#include "support/example_diagnosis.hpp"
#include "support/example_diagnosis_file.hpp"
#include "support/temporary_folder.hpp"
#include "unit/store/example_result.hpp"

namespace torquescope {
namespace diagnosis_file_test {

using ::testing::HasSubstr;

Diagnosis written_and_read(Diagnosis const& diagnosis, std::string const& file = "R.h5") {
  test::TemporaryFolder const folder;
  example::write_diagnosis_file(folder / file, diagnosis);
  ResultReader const reader(folder / file);
  EXPECT_TRUE(has_diagnosis(reader));
  EXPECT_EQ(read_verdict_json(reader), diagnosis_json(diagnosis));
  return read_diagnosis(reader);
}

void expect_same_bits(Eigen::VectorXd const& a, Eigen::VectorXd const& b) {
  ASSERT_EQ(a.size(), b.size());
  for (Eigen::Index i = 0; i < a.size(); ++i) EXPECT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])));
}

// what the JSON does not tell
void expect_same_map(JointDiagnosis const& read, JointDiagnosis const& written) {
  ASSERT_EQ(read.map.size(), written.map.size());
  for (std::size_t a = 0; a < read.map.size(); ++a) {
    MapAxis const &one = read.map[a], &other = written.map[a];
    EXPECT_EQ(one.axis, other.axis);  // in the same order
    EXPECT_EQ(one.is_spectrum, other.is_spectrum);
    EXPECT_EQ(one.p, other.p);
    ASSERT_EQ(one.cells.size(), other.cells.size());
    EXPECT_EQ(one.cells[3].from, other.cells[3].from);
    EXPECT_EQ(one.cells[3].to, other.cells[3].to);
    EXPECT_EQ(one.cells[3].samples, other.cells[3].samples);
    EXPECT_EQ(one.cells[3].mean_residual, other.cells[3].mean_residual);
    EXPECT_EQ(one.cells[3].replicate_mean, other.cells[3].replicate_mean);
    EXPECT_EQ(one.cells[3].replicate_std, other.cells[3].replicate_std);
    EXPECT_EQ(one.cells[3].z, other.cells[3].z);
    EXPECT_EQ(one.cells[3].after_z, other.cells[3].after_z);
    EXPECT_EQ(one.cells[3].after_residual, other.cells[3].after_residual);
  }
}

TEST(DiagnosisFile, GivesBackWhatTheJsonTells) {
  for (auto const& diagnosis :
       {example::invented_diagnosis(), example::invented_class(), example::invented_partly(), example::invented_none(),
        example::invented_unexplained(), example::invented_insufficient(), example::invented_data_fault()})
    EXPECT_EQ(diagnosis_json(written_and_read(diagnosis)), diagnosis_json(diagnosis));
}

TEST(DiagnosisFile, GivesBackWhatOnlyThePageTells) {
  Diagnosis const written = example::invented_diagnosis();
  Diagnosis const read = written_and_read(written);
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.q, written.q);
  ASSERT_EQ(read.joints.size(), 1u);
  JointDiagnosis const &a = read.joints[0], &b = written.joints[0];
  expect_same_map(a, b);
  EXPECT_EQ(a.cv_relerr, b.cv_relerr);
  EXPECT_EQ(a.augmented_cv_relerr, b.augmented_cv_relerr);
  EXPECT_EQ(a.nuisances, b.nuisances);
  EXPECT_EQ(a.replicates, b.replicates);
  EXPECT_EQ(a.omnibus_p, b.omnibus_p);
  EXPECT_EQ(a.mismatch_rms, b.mismatch_rms);
  EXPECT_EQ(a.left_rms, b.left_rms);
  EXPECT_EQ(a.replicate_energy, b.replicate_energy);
  EXPECT_EQ(a.unit_position, b.unit_position);
  EXPECT_EQ(a.unit_torque, b.unit_torque);

  ASSERT_EQ(a.candidates.size(), b.candidates.size());
  for (std::size_t i = 0; i < a.candidates.size(); ++i) {
    EXPECT_EQ(a.candidates[i].name, b.candidates[i].name);
    EXPECT_EQ(a.candidates[i].decision, b.candidates[i].decision);
    EXPECT_EQ(a.candidates[i].reason, b.candidates[i].reason);
    EXPECT_EQ(a.candidates[i].p, b.candidates[i].p);
  }
  ASSERT_EQ(a.effects.size(), 2u);
  EXPECT_EQ(a.effects[0].title, b.effects[0].title);
  EXPECT_EQ(a.effects[0].equation, b.effects[0].equation);
  EXPECT_EQ(a.effects[0].peak, b.effects[0].peak);
  EXPECT_EQ(a.effects[1].curve.axis.axis, "position");
  EXPECT_EQ(a.effects[1].curve.partial, b.effects[1].curve.partial);
  EXPECT_EQ(a.effects[1].curve.spread, b.effects[1].curve.spread);

  ASSERT_EQ(a.traces.size(), 1u);
  EXPECT_EQ(a.traces[0].recording, b.traces[0].recording);
  expect_same_bits(a.traces[0].time_s, b.traces[0].time_s);
  expect_same_bits(a.traces[0].before, b.traces[0].before);  // masked rows are NaN
  expect_same_bits(a.traces[0].after, b.traces[0].after);
  expect_same_bits(a.traces[0].position, b.traces[0].position);
  ASSERT_EQ(a.forward.size(), 1u);
  EXPECT_EQ(a.forward[0].after_rms, b.forward[0].after_rms);
  EXPECT_EQ(a.forward[0].encoder_step, b.forward[0].encoder_step);
}

TEST(DiagnosisFile, KeepsTheTextsOfThePoorVerdicts) {
  EXPECT_EQ(written_and_read(example::invented_insufficient()).finding, "only one direction of motion was recorded");
  EXPECT_EQ(written_and_read(example::invented_insufficient()).way_out, "record both directions");
  EXPECT_EQ(written_and_read(example::invented_none()).joints[0].power_sentence,
            "A 5 % Stribeck effect would have shown.");
}

TEST(DiagnosisFile, KeepsTheNameOfTheJoint) {
  Diagnosis diagnosis = example::invented_diagnosis();
  diagnosis.joints[0].name = "q5_rad";
  EXPECT_EQ(written_and_read(diagnosis).joints[0].name, "q5_rad");
}

TEST(DiagnosisFile, KeepsTheShareThatIsExplained) {
  Diagnosis const kept = written_and_read(example::invented_partly());
  EXPECT_EQ(kept.verdict, Verdict::partly);
  EXPECT_EQ(kept.joints[0].explained_share, 0.71);
  EXPECT_EQ(kept.joints[0].unexplained.size(), 2u);
  EXPECT_TRUE(std::isnan(written_and_read(example::invented_diagnosis()).joints[0].explained_share));
}

TEST(DiagnosisFile, OfAnEarlierVersionIsReadWithoutTheShare) {
  test::TemporaryFolder const folder;
  {
    ResultWriter writer(folder / "R.h5");
    writer.attribute("/diagnosis", "verdict", std::string("named"));
    writer.attribute("/diagnosis/joint_1", "joint", std::int64_t{1});
    writer.attribute("/diagnosis/joint_1", "train_relerr", 0.12);
    writer.attribute("/diagnosis/joint_1", "rows", std::string("all"));
    writer.finish();
  }
  Diagnosis const read = read_diagnosis(ResultReader(folder / "R.h5"));
  ASSERT_EQ(read.joints.size(), 1u);
  EXPECT_EQ(read.joints[0].train_relerr, 0.12);
  EXPECT_TRUE(std::isnan(read.joints[0].explained_share));
}

// a file with one joint; rows "": it does not say of which rows its errors are
Diagnosis read_with(std::string const& rows, double train_relerr) {
  test::TemporaryFolder const folder;
  {
    ResultWriter writer(folder / "R.h5");
    writer.attribute("/diagnosis", "verdict", std::string("named"));
    writer.attribute("/diagnosis/joint_1", "train_relerr", train_relerr);
    if (!rows.empty()) writer.attribute("/diagnosis/joint_1", "rows", rows);
    writer.finish();
  }
  return read_diagnosis(ResultReader(folder / "R.h5"));
}

TEST(DiagnosisFile, WithErrorsOfOtherRowsIsRefusedWithTheWayOut) {
  for (std::string const rows : {"moving one way", "with reversals", ""}) {
    SCOPED_TRACE(rows);
    std::string const told = rows.empty() ? "moving one way" : rows;
    try {
      read_with(rows, 0.12);
      ADD_FAILURE() << "errors of other rows were taken for those of all samples";
    } catch (Error const& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_THAT(error.what(), HasSubstr("R.h5 are of rows " + told + ": it was made by Torquescope 0.1"));
      EXPECT_EQ(error.problems().front().help, "delete it and run torquescope diagnose again with the job");
    }
  }
}

// joints that were given up had another word until they had the one of all
TEST(DiagnosisFile, OfAJointWithoutErrorsIsReadWhateverItsRows) {
  for (char const* rows : {"all", "moving one way", ""}) EXPECT_EQ(read_with(rows, unknown).joints.size(), 1u) << rows;
  EXPECT_EQ(read_with("all", 0.12).joints[0].train_relerr, 0.12);
}

TEST(DiagnosisFile, SaysThatErrorsAreOfAllSamplesOfJointsGivenUpToo) {
  test::TemporaryFolder const folder;
  Diagnosis diagnosis = example::invented_diagnosis();
  diagnosis.joints.emplace_back().joint = 2;
  example::write_diagnosis_file(folder / "R.h5", diagnosis);
  ResultReader const reader(folder / "R.h5");
  for (char const* joint : {"/diagnosis/joint_1", "/diagnosis/joint_2"})
    EXPECT_EQ(reader.attribute<std::string>(joint, "rows"), "all");
  EXPECT_EQ(read_diagnosis(reader).joints.size(), 2u);
}

TEST(DiagnosisFile, EqualDiagnosesHaveEqualContent) {
  test::TemporaryFolder const folder;
  EXPECT_EQ(example::write_diagnosis_file(folder / "a.h5", example::invented_diagnosis()),
            example::write_diagnosis_file(folder / "b.h5", example::invented_diagnosis()));
}

TEST(DiagnosisFile, AFileThatContradictsItselfIsRefused) {
  test::TemporaryFolder const folder;
  {
    ResultWriter writer(folder / "R.h5");
    writer.attribute("/diagnosis", "verdict", std::string("named"));
    std::string const candidates = "/diagnosis/joint_1/candidates";
    writer.texts(candidates + "/names", std::vector<std::string>{"stribeck", "cogging"}, {"1", "names"});
    writer.texts(candidates + "/families", std::vector<std::string>{"reversal"}, {"1", "families"});
    writer.finish();
  }
  try {
    read_diagnosis(ResultReader(folder / "R.h5"));
    FAIL() << "columns of two lengths were taken for a table";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_THAT(error.what(), HasSubstr("columns of different lengths"));
  }
}

TEST(DiagnosisFile, AVerdictThatDoesNotExistIsRefused) {
  test::TemporaryFolder const folder;
  {
    ResultWriter writer(folder / "R.h5");
    writer.attribute("/diagnosis", "verdict", std::string("perhaps"));
    writer.finish();
  }
  EXPECT_THROW(read_diagnosis(ResultReader(folder / "R.h5")), Error);
}

TEST(DiagnosisFile, AResultOfRunHasNone) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5");
  EXPECT_FALSE(has_diagnosis(ResultReader(folder / "R.h5")));
}

}  // namespace diagnosis_file_test
}  // namespace torquescope
