// A job's sections say where everything stands, so that every later message can point at it.

#include <gtest/gtest.h>

#include "engine/base/digest.hpp"
#include "engine/experiment/job/job.hpp"

namespace torquescope {
namespace job_places_test {

char const job_text[] =
    "# a täst\n"                                        // 1
    "[experiment]\n"                                    // 2
    "name = \"lab\"   # café\n"                         // 3
    "seed=42\n"                                         // 4
    "[recording]\n"                                     // 5
    "train = [\"a.csv\", \"b.csv\"]\n"                  // 6
    "  columns = {time = \"t_s\", torque = \"i_A\"}\n"  // 7
    "[model.bounds]\n"                                  // 8
    "inertia = [0, 1.5]\n"                              // 9
    "[[estimator]]\n"                                   // 10
    "name = \"ols\"\n"                                  // 11
    "[[estimator]]\n"                                   // 12
    "name = \"fade\"\n"                                 // 13
    "F = -1_0\n";                                       // 14

TEST(JobPlaces, KeyAndValueAreUnderlinedExactly) {
  Job const job = parse_job(job_text, "lab.toml");
  Setting const* seed = job.find("experiment")->find("seed");
  ASSERT_NE(seed, nullptr);
  EXPECT_EQ(seed->key_place.file, "lab.toml");
  EXPECT_EQ(seed->key_place.line, 4);
  EXPECT_EQ(seed->key_place.column, 1);
  EXPECT_EQ(seed->key_place.length, 4);
  EXPECT_EQ(seed->value_place.column, 6);
  EXPECT_EQ(seed->value_place.length, 2);
  EXPECT_EQ(seed->value_place.line_text, "seed=42");
}

TEST(JobPlaces, SectionsStandInTheOrderOfTheFile) {
  Job const job = parse_job(job_text, "lab.toml");
  std::vector<std::string> names;
  for (auto const& section : job.sections) names.push_back(section.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"experiment", "recording", "model", "model.bounds", "estimator", "estimator"}));
  EXPECT_EQ(job.find("recording")->place.line, 5);
  EXPECT_EQ(job.find("recording")->place.line_text, "[recording]");
}

TEST(JobPlaces, EstimatorsKeepTheirOrderAndTheirOwnKeys) {
  Job const job = parse_job(job_text, "lab.toml");
  auto const estimators = job.all("estimator");
  ASSERT_EQ(estimators.size(), 2u);
  EXPECT_EQ(std::get<std::string>(estimators[0]->find("name")->value), "ols");
  EXPECT_EQ(std::get<std::string>(estimators[1]->find("name")->value), "fade");
  EXPECT_EQ(std::get<std::int64_t>(estimators[1]->find("F")->value), -10);
  EXPECT_EQ(estimators[1]->place.line, 12);
}

TEST(JobPlaces, ColumnsAreAMapWrittenEitherWay) {
  std::map<std::string, std::string> const columns{{"time", "t_s"}, {"torque", "i_A"}};
  Job const inline_table = parse_job(job_text, "lab.toml");
  Setting const* setting = inline_table.find("recording")->find("columns");
  ASSERT_NE(setting, nullptr);
  EXPECT_EQ(std::get<6>(setting->value), columns);
  EXPECT_EQ(setting->value_place.line, 7);
  EXPECT_EQ(setting->value_place.column, 13);

  Job const header = parse_job("[recording]\n[recording.columns]\ntime = \"t_s\"\ntorque = \"i_A\"\n", "lab.toml");
  ASSERT_NE(header.find("recording")->find("columns"), nullptr);
  EXPECT_EQ(std::get<6>(header.find("recording")->find("columns")->value), columns);
  EXPECT_EQ(header.find("recording")->find("columns")->value_place.line, 2);
}

TEST(JobPlaces, ATableIsASectionWhateverItsValuesAre) {
  Job const job = parse_job("[simulate]\nplant = {kind = \"joint\"}\n[simulate.noise]\n", "lab.toml");
  ASSERT_NE(job.find("simulate.plant"), nullptr);
  EXPECT_EQ(std::get<std::string>(job.find("simulate.plant")->find("kind")->value), "joint");
  EXPECT_EQ(job.find("simulate.plant")->place.line, 2);
  ASSERT_NE(job.find("simulate.noise"), nullptr);
  EXPECT_TRUE(job.find("simulate.noise")->settings.empty());
  EXPECT_TRUE(job.find("simulate")->settings.empty());
}

TEST(JobPlaces, ListsOfNumbersAreNumbersEvenWhenWrittenWhole) {
  Job const job = parse_job(job_text, "lab.toml");
  EXPECT_EQ(std::get<std::vector<double>>(job.find("model.bounds")->find("inertia")->value),
            (std::vector<double>{0.0, 1.5}));
}

TEST(JobPlaces, TextAndDigestAreThoseOfTheFile) {
  Job const job = parse_job(job_text, "lab.toml");
  EXPECT_EQ(job.text, job_text);
  EXPECT_EQ(job.sha256, sha256_hex(job_text));
}

TEST(JobPlaces, PathsAreRelativeToTheJob) {
  Job const job = parse_job("", "jobs/lab.toml");
  EXPECT_EQ(job.resolve("data/a.csv"), std::filesystem::path("jobs/data/a.csv"));
  EXPECT_EQ(job.resolve("/data/a.csv"), std::filesystem::path("/data/a.csv"));
}

}  // namespace job_places_test
}  // namespace torquescope
