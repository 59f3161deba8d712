#include "engine/run/catalogue.hpp"

#include <gtest/gtest.h>

#include <set>

#include "engine/run/job_sections.hpp"

namespace torquescope {
namespace {

TEST(Catalogue, NamesEveryThingOnceAndSaysWhatItIs) {
  std::set<std::string> names;
  std::set<std::string> kinds;
  for (auto const& entry : catalogue()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_FALSE(entry.title.empty()) << entry.name;
    kinds.insert(entry.kind);
    for (auto const& option : entry.options) EXPECT_FALSE(option.meaning.empty()) << entry.name << "." << option.key;
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"effect", "estimator", "loss", "optimiser", "reader", "section"}));
}

TEST(Catalogue, DescribesEverySectionAJobMayHave) {
  for (auto const& section : known_sections()) {
    bool found = false;
    for (auto const& entry : catalogue()) found = found || (entry.kind == "section" && entry.name == section);
    EXPECT_TRUE(found) << section;
  }
}

}  // namespace
}  // namespace torquescope
