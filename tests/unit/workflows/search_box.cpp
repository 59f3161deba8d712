#include "engine/experiment/search_box.hpp"

#include <gtest/gtest.h>

namespace torquescope {
namespace search_box_test {

Setting range(std::string const& key, std::vector<double> const& values) {
  return {key, values, {"job.toml", 9, 1, 7, ""}, {"job.toml", 9, 11, 9, ""}};
}

Section bounds_section(std::vector<Setting> settings) {
  return Section{"model.bounds", {"job.toml", 8, 1, 14, ""}, std::move(settings)};
}

TEST(SearchBox, IsMinusOneToOneUnlessSaidOtherwise) {
  std::vector<Problem> problems;
  Bounds const box = read_search_box({"inertia", "viscous"}, nullptr, problems);
  EXPECT_EQ(box.lower, (std::vector<double>{-1.0, -1.0}));
  EXPECT_EQ(box.upper, (std::vector<double>{1.0, 1.0}));
}

TEST(SearchBox, AParametersOwnRangeOverridesEveryWhereverItStands) {
  Section const section = bounds_section({range("viscous", {0, 5}), range("every", {-2, 2})});
  std::vector<Problem> problems;
  Bounds const box = read_search_box({"inertia", "viscous"}, &section, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(box.lower, (std::vector<double>{-2.0, 0.0}));
  EXPECT_EQ(box.upper, (std::vector<double>{2.0, 5.0}));
}

TEST(SearchBox, TellsEveryProblemAtOnce) {
  Section const section = bounds_section({range("inertai", {0, 1}), range("viscous", {3, 3}), range("every", {1})});
  std::vector<Problem> problems;
  read_search_box({"inertia", "viscous"}, &section, problems);
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[0].what, "every = [1] is not a range");
  EXPECT_EQ(problems[1].caret_note, "did you mean \"inertia\"?");
  EXPECT_EQ(problems[2].key, "model.bounds.viscous");
  EXPECT_NE(problems[2].help.find("viscous = [-1.0, 1.0]"), std::string::npos);
}

}  // namespace search_box_test
}  // namespace torquescope
