// What is said of errors never contradicts them: no likeness beside a small p, no silence where the validation
// recording is of another kind.

#include "engine/account/error_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/account/sentences.hpp"
#include "support/example_diagnosis.hpp"

namespace torquescope {
namespace error_words_test {

using ::testing::HasSubstr;
using ::testing::Not;

// smooth functions may be beyond chance and too small to matter
TEST(ReasonSentence, OfNothingMissingDoesNotCallAResidualAlikeThatDiffers) {
  Diagnosis diagnosis = example::invented_none();
  JointDiagnosis& joint = diagnosis.joints[0];
  joint.power_sentence.clear();
  joint.omnibus_p = 1.0 / 201.0;
  EXPECT_EQ(reason_sentence(diagnosis),
            "The residual of joint 1 differs from that of 200 simulated replicates (p < 0.005), but by too little for "
            "a name.");
  joint.omnibus_p = 0.2;
  EXPECT_EQ(reason_sentence(diagnosis),
            "The residual of joint 1 looks like that of 200 simulated replicates (p = 0.20).");
}

// one candidate's certainty opened the gate, and then it was refused
TEST(ReasonSentence, OfSomethingElseInAResidualThatIsNoLargerNamesWhatWasRefused) {
  Diagnosis diagnosis = example::invented_unexplained();
  JointDiagnosis& joint = diagnosis.joints[0];
  joint.unexplained.clear();
  joint.omnibus_p = 1.0;
  for (auto& candidate : joint.candidates) candidate.q = 1.0;
  joint.candidates.push_back({"transmission_error", "order_locked", 8.2, 0.005, 1e-6});
  joint.candidates.back().reason = "does not help on blocks it was not fitted to";
  EXPECT_EQ(reason_sentence(diagnosis),
            "The residual of joint 1 is no larger than that of simulated replicates (p = 1.0), but transmission_error "
            "explains "
            "more of it "
            "than of theirs (beyond chance). It gets no name: does not help on blocks it was not fitted to.");
  joint.omnibus_p = 0.01;
  EXPECT_THAT(reason_sentence(diagnosis), HasSubstr("is not what simulated replicates have (p = 0.010), but"));
  joint.omnibus_p = 1.0;
  joint.candidates.back().q = 0.9;
  EXPECT_THAT(reason_sentence(diagnosis), HasSubstr("is not what simulated replicates have (p = 1.0), but"));
}

TEST(ReasonSentence, SaysWhateverTheVerdictThatTheValidationRecordingIsOfAnotherKind) {
  char const* said =
      "The validation recording holds something that the training recording does not show, or its motion asks for "
      "numbers that training does not determine: error 18.4 % there, 0.82 % here.";
  for (auto diagnosis : {example::invented_diagnosis(), example::invented_none(), example::invented_unexplained(),
                         example::invented_data_fault()}) {
    EXPECT_THAT(reason_sentence(diagnosis), Not(HasSubstr("holds something")));
    EXPECT_THAT(way_out_of_a_fault(diagnosis.joints[0], true), HasSubstr("; the model itself needs nothing more"));
    JointDiagnosis& joint = diagnosis.joints[0];
    joint.train_relerr = 0.0091;
    joint.validation_relerr = 0.185;
    joint.augmented_train_relerr = 0.0082;
    joint.augmented_validation_relerr = 0.184;
    EXPECT_THAT(reason_sentence(diagnosis), HasSubstr(said));
    EXPECT_THAT(way_out_of_a_fault(joint, true), Not(HasSubstr("needs nothing more")));
    EXPECT_THAT(way_out_of_a_fault(joint, false), Not(HasSubstr("needs nothing more")));
    // what naming mends was missing in training as well
    joint.augmented_validation_relerr = 0.02;
    EXPECT_THAT(reason_sentence(diagnosis), Not(HasSubstr("holds something")));
    // names that were withdrawn have no errors
    joint.augmented_train_relerr = joint.augmented_validation_relerr = unknown;
    EXPECT_THAT(reason_sentence(diagnosis), HasSubstr("error 18.5 % there, 0.91 % here."));
  }
}

}  // namespace error_words_test
}  // namespace torquescope
