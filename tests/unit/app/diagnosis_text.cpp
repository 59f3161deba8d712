// The page of a diagnosis in a terminal: at most 80 columns, also without UTF-8.

#include "engine/app/result/diagnosis_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "engine/app/result/candidate_text.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "support/example_diagnosis.hpp"

namespace torquescope {
namespace diagnosis_text_test {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> lines_of(std::string const& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

constexpr DiagnosisTextOptions everything{.all_candidates = true};

std::vector<Diagnosis> all_verdicts() {
  return {example::invented_diagnosis(), example::invented_class(),       example::invented_partly(),
          example::invented_none(),      example::invented_unexplained(), example::invented_insufficient(),
          example::invented_data_fault()};
}

TEST(DiagnosisText, IsThePictureOfTheSpecification) {
  EXPECT_EQ(diagnosis_text(example::invented_class(), {}, Ink()),
            R"(◍ ONE OF A CLASS  Stribeck friction 0.35 N m [0.34, 0.37], speed 0.060 rad/s
                  [0.055, 0.065], exponent 1.0 [0.91, 1.1] or presliding,
                  p < 0.005
    error, all samples: training 11.8 % -> 6.1 %, validation 12.1 % -> 6.2 %
    in validation: offset; phase of cogging
next   triangular strokes of 0.2, 1 and 5 mrad: would tell stribeck and
       presliding apart
)");
}

TEST(DiagnosisText, WithEverythingShowsTheReasonTheMapAndTheCandidates) {
  std::string const text = evidence_text(example::invented_class(), everything, Ink());
  EXPECT_THAT(text, StartsWith("\nJoint 1 loses 0.35 N m extra below 0.12 rad/s in both directions: stribeck or"));
  EXPECT_THAT(text, HasSubstr("where  velocity  -1.1  ▄▃▃▃▂▂▁▃█▁▂▂▂▂▃▃  1.0 rad/s  46 % of the residual\n"));
  EXPECT_THAT(text, HasSubstr("       presliding                   10.9  <0.005   27.6 %  class\n"));
  EXPECT_THAT(text, HasSubstr("why    (1) explains less than stribeck\n"));
}

TEST(DiagnosisText, EveryVerdictHasItsMarkAndWord) {
  std::vector<std::string> const beginnings{"● NAMED  ",           "◍ ONE OF A CLASS  ", "◐ PARTLY EXPLAINED  ",
                                            "○ NOTHING MISSING  ", "◌ UNEXPLAINED  ",    "▽ INSUFFICIENT  ",
                                            "✕ DATA FAULT  "};
  auto const diagnoses = all_verdicts();
  for (std::size_t i = 0; i < diagnoses.size(); ++i) {
    EXPECT_THAT(diagnosis_text(diagnoses[i], {}, Ink()), StartsWith(beginnings[i]));
    // the word stays where the mark cannot be shown
    std::string const ascii = diagnosis_text(diagnoses[i], {.utf8 = false}, Ink());
    EXPECT_THAT(ascii, StartsWith("* " + beginnings[i].substr(beginnings[i].find(' ') + 1)));
    for (char const letter : ascii) EXPECT_GE(letter, 0) << ascii;
  }
}

TEST(DiagnosisText, AFaultBesidePhysicsStandsInTheHeadline) {
  for (auto diagnosis : {example::invented_diagnosis(), example::invented_class(), example::invented_partly()}) {
    std::string const before = verdict_text(diagnosis, true, Ink());
    EXPECT_THAT(before, Not(HasSubstr("FAULT")));
    NamedEffect delay = diagnosis.joints[0].effects[0];
    delay.acts_on = "recorded_torque";
    delay.equivalent.clear();  // one that physics explains as well is no fault
    diagnosis.joints[0].effects.push_back(delay);
    EXPECT_THAT(verdict_text(diagnosis, true, Ink()),
                StartsWith(before.substr(0, before.find("  ")) + " + DATA FAULT  "));
  }
}

TEST(DiagnosisText, ACrossValidatedGainStandsWhereThereIsOne) {
  EXPECT_THAT(diagnosis_text(example::invented_diagnosis(), everything, Ink()), HasSubstr("CV gain"));
  Diagnosis diagnosis = example::invented_diagnosis();
  diagnosis.joints[0].candidates[1].cv_gain = unknown;
  EXPECT_THAT(diagnosis_text(diagnosis, everything, Ink()), HasSubstr("blank:"));
  for (auto& one : diagnosis.joints[0].candidates) one.cv_gain = unknown;
  EXPECT_THAT(diagnosis_text(diagnosis, everything, Ink()), Not(HasSubstr("CV gain")));
}

TEST(DiagnosisText, OfAPartShowsTheMapOfWhatIsLeft) {
  Diagnosis diagnosis = example::invented_partly();
  std::string const text = diagnosis_text(diagnosis, everything, Ink());
  // what is left lies in the last third of the travel; the baseline's own map stands above it
  EXPECT_THAT(text, HasSubstr("\nleft   position"));
  EXPECT_THAT(text,
              ::testing::ContainsRegex("\nleft   position +-0.80  [▁▂▃]+[▅▆▇█]+  0.90 rad +21 % of the residual\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("\n       load +-1.5  [^\n]* 9 %\n"));
  EXPECT_LT(text.find("\nwhere  "), text.find("\nleft   "));
  diagnosis.joints[0].unexplained.clear();
  EXPECT_THAT(diagnosis_text(diagnosis, everything, Ink()), Not(HasSubstr("\nleft   ")));
  EXPECT_THAT(diagnosis_text(example::invented_diagnosis(), everything, Ink()), Not(HasSubstr("\nleft   ")));
}

TEST(DiagnosisText, NoLineIsWiderThanThePage) {
  for (auto diagnosis : all_verdicts())
    for (bool all : {false, true})
      for (auto const& line : lines_of(diagnosis_text(diagnosis, {.all_candidates = all}, Ink(true)) +
                                       diagnosed_model_text(diagnosis, Ink(true))))
        EXPECT_LE(columns_of(line), widest_page) << line;
}

TEST(DiagnosisText, NumbersStayWithWhatBelongsToThem) {
  Diagnosis diagnosis = example::invented_none();
  for (int words = 0; words < 40; ++words) {
    diagnosis.reason =
        std::string(static_cast<std::size_t>(words), 'x') + " replicates (p = 0.41) have 6.0 % (p < 0.005) left";
    for (auto const& line : lines_of(evidence_text(diagnosis, everything, Ink()))) {
      EXPECT_THAT(line, Not(::testing::MatchesRegex(".*(p|p =|p <|6\\.0)"))) << line;
      EXPECT_THAT(line, Not(HasSubstr("\u00A0")));
    }
  }
}

TEST(DiagnosisText, ColourNeverCarriesTheMeaning) {
  for (auto const& diagnosis : all_verdicts()) {
    std::string inked = diagnosis_text(diagnosis, {}, Ink(true));
    EXPECT_THAT(inked, HasSubstr("\x1b["));
    for (std::size_t at; (at = inked.find('\x1b')) != std::string::npos;) inked.erase(at, inked.find('m', at) - at + 1);
    EXPECT_EQ(inked, diagnosis_text(diagnosis, {}, Ink()));
  }
}

TEST(DiagnosisText, AllShowsEveryCandidate) {
  Diagnosis const diagnosis = example::invented_diagnosis();
  std::string const some = diagnosis_text(diagnosis, {}, Ink());
  std::string const all = diagnosis_text(diagnosis, {.all_candidates = true}, Ink());
  EXPECT_THAT(some, Not(HasSubstr("what   ")));
  for (auto const& candidate : diagnosis.joints[0].candidates)
    EXPECT_THAT(all, HasSubstr("\n       " + candidate.name + " ")) << candidate.name;
}

TEST(DiagnosisText, EveryCandidateThatIsNotNamedHasItsReason) {
  Diagnosis diagnosis = example::invented_class();
  auto& candidates = diagnosis.joints[0].candidates;
  std::string const all = diagnosis_text(diagnosis, {.all_candidates = true}, Ink());
  for (char const* words :
       {"\nwhy    (1) explains less than stribeck\n", "\n       (2) nothing is left of it beside stribeck\n",
        "\n       (3) no stronger than chance\n"})
    EXPECT_THAT(all, HasSubstr(words));
  EXPECT_THAT(all, Not(HasSubstr("(4)")));  // a reason is said once
  EXPECT_THAT(all, ::testing::ContainsRegex("power_law_viscous .* no \\(2\\)\n"));
  for (auto& one : candidates) one.reason = "evil\x1b[2J";
  EXPECT_THAT(diagnosis_text(diagnosis, {.all_candidates = true}, Ink()), Not(HasSubstr("\x1b")));
}

TEST(DiagnosisText, WhatWasNotTestedSaysSo) {
  Diagnosis diagnosis = example::invented_none();
  auto& candidates = diagnosis.joints[0].candidates;
  Candidate const term{"coulomb_positive",           "baseline", 0.0, 1.0, 1.0, 0.0, unknown, Decision::not_tested,
                       "a term of the model already"};
  candidates.insert(candidates.begin(), 2, term);
  std::string const all = diagnosis_text(diagnosis, everything, Ink());
  EXPECT_THAT(all, HasSubstr("\n       coulomb_positive "));
  EXPECT_THAT(all, HasSubstr("\n       not tested: a term of the model already\n"));
}

TEST(DiagnosisText, AShareOfTheMismatchIsReadable) {
  EXPECT_EQ(cv_gain_cell(0.284), "28.4 %");
  EXPECT_EQ(cv_gain_cell(106.72), "> 100 %");
  EXPECT_EQ(cv_gain_cell(-5.81), "none");
  EXPECT_EQ(cv_gain_cell(0.0), "none");
  EXPECT_EQ(cv_gain_cell(unknown), "");
}

TEST(DiagnosisText, WhatIsUnexplainedHasANextStepToo) {
  Diagnosis diagnosis = example::invented_unexplained();
  diagnosis.joints[0].excitation = {{"full turns", {"backlash"}}};
  EXPECT_THAT(diagnosis_text(diagnosis, {}, Ink()),
              HasSubstr("\nnext   full turns: would tell whether it is backlash, which came closest\n"));
}

TEST(DiagnosisText, QuietAxesAreCountedAndUnrecordedPlacesAreBlank) {
  EXPECT_THAT(diagnosis_text(example::invented_none(), everything, Ink()),
              HasSubstr("where  9 axes: nothing beyond the replicates\n"));
  Diagnosis diagnosis = example::invented_diagnosis();
  for (std::size_t i = 0; i < 27; ++i) diagnosis.joints[0].map[0].cells[i].samples = 0;
  EXPECT_THAT(diagnosis_text(diagnosis, everything, Ink()), HasSubstr("velocity  -1.1          "));
}

TEST(DiagnosisText, NamesFromAJobCannotSteerTheTerminal) {
  Diagnosis diagnosis = example::invented_diagnosis();
  diagnosis.reason = "evil \x1b[2J";
  diagnosis.joints[0].candidates[0].name = "evil\x1b[2J";
  diagnosis.joints[0].excitation[0].lacks = "evil\x1b[2J";
  EXPECT_THAT(diagnosis_text(diagnosis, {}, Ink()), Not(HasSubstr("\x1b")));
}

TEST(DiagnosedModelText, ShowsEveryParameterBeforeAndAfter) {
  std::string const text = diagnosed_model_text(example::invented_diagnosis(), Ink());
  EXPECT_THAT(text, HasSubstr("0.52 +- 0.0090"));
  EXPECT_THAT(text, HasSubstr("stribeck_speed"));
  EXPECT_THAT(text, HasSubstr("12.1 %"));
}

TEST(DiagnosedModelText, ShowsTheShareThatIsExplainedWhereItIsKnown) {
  Diagnosis diagnosis = example::invented_partly();
  EXPECT_THAT(diagnosed_model_text(diagnosis, Ink()), ::testing::ContainsRegex("explained, held-out rows +71 %"));
  diagnosis.joints[0].explained_share = unknown;
  EXPECT_THAT(diagnosed_model_text(diagnosis, Ink()), Not(HasSubstr("explained")));
}

}  // namespace diagnosis_text_test
}  // namespace torquescope
