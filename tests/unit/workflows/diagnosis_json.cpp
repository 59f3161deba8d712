// The verdict's JSON has exactly the documented keys, in every verdict, and nothing unknown is a number.

#include "engine/workflows/results/diagnosis_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "support/example_diagnosis.hpp"

namespace torquescope {
namespace diagnosis_json_test {

using Json = nlohmann::json;

// all keys, values left out: a list holds the pattern of its elements
Json const pattern = Json::parse(R"({
  "schema": 1, "verdict": "", "headline": "", "reason": "", "findings": [],
  "joints": [{
    "joint": 1, "name": "", "twins": 0,
    "baseline": {"parameters": [{"name": "", "value": 0, "unit": "", "ci95": [0]}],
                 "train_relerr": 0, "validation_relerr": 0, "cv_relerr": 0},
    "mismatch": [{"axis": "", "from": 0, "to": 0, "unit": "", "time_share": 0, "energy_share": 0,
                  "repeatable_share": 0}],
    "effects": [{"name": "", "family": "", "acts_on": "", "equivalent": [""],
                 "p": 0, "p_is_bound": false, "p_extrapolated": 0, "q": 0, "z": 0,
                 "gain": {"train": 0, "cv": 0},
                 "region": {"axis": "", "from": 0, "to": 0},
                 "parameters": [{"name": "", "value": 0, "unit": "", "ci95": [0]}], "sentence": ""}],
    "candidates": [{"name": "", "family": "", "decision": "", "reason": "", "z": 0, "p": 0,
                    "p_is_bound": false, "p_extrapolated": 0, "q": 0, "gain": 0, "cv_gain": 0}],
    "augmented": {"train_relerr": 0, "validation_relerr": 0, "cv_relerr": 0,
                  "parameters": [{"name": "", "value": 0, "unit": "", "ci95": [0]}]},
    "explained": {"share": 0},
    "budget": {"parameter_error": 0, "missing_physics": 0, "unexplained": 0, "noise": 0},
    "unexplained": [{"axis": "", "from": 0, "to": 0, "energy_share": 0}],
    "excitation": [{"lacks": "", "would_separate": [""]}]}]})");

std::set<std::string> keys_of(Json const& object) {
  std::set<std::string> keys;
  for (auto const& [key, value] : object.items()) keys.insert(key);
  return keys;
}

// same keys everywhere, same kinds of values; null stands for an unknown number
void expect_like(Json const& document, Json const& wanted, std::string const& place) {
  SCOPED_TRACE(place);
  if (wanted.is_object()) {
    ASSERT_TRUE(document.is_object());
    ASSERT_EQ(keys_of(document), keys_of(wanted));
    for (auto const& [key, value] : wanted.items()) expect_like(document.at(key), value, place + "." + key);
  } else if (wanted.is_array()) {
    ASSERT_TRUE(document.is_array());
    for (auto const& element : document) expect_like(element, wanted.front(), place + "[]");
  } else if (wanted.is_number()) {
    EXPECT_TRUE(document.is_number() || document.is_null());
  } else if (wanted.is_boolean()) {
    EXPECT_TRUE(document.is_boolean());
  } else {
    EXPECT_TRUE(document.is_string());
  }
}

TEST(DiagnosisJson, HasExactlyTheKeysOfTheSpecificationInEveryVerdict) {
  for (auto const& diagnosis :
       {example::invented_diagnosis(), example::invented_class(), example::invented_partly(), example::invented_none(),
        example::invented_unexplained(), example::invented_insufficient(), example::invented_data_fault()}) {
    Json const document = Json::parse(diagnosis_json(diagnosis));
    expect_like(document, pattern, word(diagnosis.verdict));
    EXPECT_EQ(document["schema"], 1);
    EXPECT_EQ(document["verdict"], word(diagnosis.verdict));
  }
}

TEST(DiagnosisJson, TellsTheNumbersUnrounded) {
  Json const document = Json::parse(diagnosis_json(example::invented_diagnosis()));
  Json const& joint = document["joints"][0];
  EXPECT_EQ(joint["effects"][0]["p"], 1.0 / 201.0);
  EXPECT_EQ(joint["baseline"]["validation_relerr"], 0.1213);
  EXPECT_EQ(joint["baseline"]["cv_relerr"], 0.1196);
  EXPECT_EQ(joint["augmented"]["cv_relerr"], 0.0617);
  EXPECT_EQ(joint["effects"][0]["parameters"][0]["ci95"], Json::parse("[0.342, 0.366]"));
  EXPECT_EQ(joint["effects"][0]["equivalent"], Json::parse(R"(["presliding"])"));
  // regions of all axes in one list
  ASSERT_EQ(joint["mismatch"].size(), 3u);
  EXPECT_EQ(joint["mismatch"][2]["axis"], "order");
}

TEST(DiagnosisJson, TellsTheShareThatIsExplained) {
  Diagnosis diagnosis = example::invented_partly();
  Json document = Json::parse(diagnosis_json(diagnosis));
  EXPECT_EQ(document["verdict"], "partly");
  EXPECT_EQ(document["joints"][0]["explained"], Json::parse(R"({"share": 0.71})"));
  EXPECT_EQ(document["joints"][0]["effects"].size(), 2u);
  diagnosis.joints[0].explained_share = unknown;
  document = Json::parse(diagnosis_json(diagnosis));
  EXPECT_EQ(document["joints"][0]["explained"], Json::parse(R"({"share": null})"));
}

// the screen says < 0.005 of it
TEST(DiagnosisJson, TellsNoPThatTheReplicatesCannotCount) {
  Diagnosis diagnosis = example::invented_diagnosis();
  diagnosis.joints[0].effects[0].p = diagnosis.joints[0].candidates[0].p = 3e-7;
  diagnosis.joints[0].candidates[1].p = 0.02;
  Json const joint = Json::parse(diagnosis_json(diagnosis))["joints"][0];
  for (Json const& one : {joint["effects"][0], joint["candidates"][0]}) {
    EXPECT_EQ(one["p"], 1.0 / 201.0);
    EXPECT_EQ(one["p_is_bound"], true);
    EXPECT_EQ(one["p_extrapolated"], 3e-7);
  }
  EXPECT_EQ(joint["candidates"][1]["p"], 0.02);
  EXPECT_EQ(joint["candidates"][1]["p_is_bound"], false);
}

TEST(DiagnosisJson, UnknownNumbersAreNull) {
  Diagnosis diagnosis = example::invented_diagnosis();
  diagnosis.joints[0].validation_relerr = unknown;
  diagnosis.joints[0].effects[0].z = std::numeric_limits<double>::infinity();
  Json const document = Json::parse(diagnosis_json(diagnosis));
  EXPECT_TRUE(document["joints"][0]["baseline"]["validation_relerr"].is_null());
  EXPECT_TRUE(document["joints"][0]["effects"][0]["z"].is_null());
}

TEST(DiagnosisJson, SurvivesTextsThatAreNoUtf8) {
  Diagnosis diagnosis = example::invented_none();
  diagnosis.reason = "caf\xe9";
  EXPECT_TRUE(Json::parse(diagnosis_json(diagnosis)).contains("reason"));
}

}  // namespace diagnosis_json_test
}  // namespace torquescope
