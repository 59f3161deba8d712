#include "engine/experiment/catalogue.hpp"

#include <gtest/gtest.h>

#include <set>

#include "engine/experiment/job_sections.hpp"

namespace torquescope {
namespace catalogue_test {

TEST(Catalogue, NamesEveryThingOnceAndSaysWhatItIs) {
  std::set<std::string> names;
  std::set<std::string> kinds;
  for (auto const& entry : catalogue()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_FALSE(entry.title.empty()) << entry.name;
    kinds.insert(entry.kind);
    for (auto const& option : entry.options) EXPECT_FALSE(option.meaning.empty()) << entry.name << "." << option.key;
  }
  EXPECT_EQ(kinds,
            (std::set<std::string>{"effect", "estimator", "law", "loss", "optimiser", "reader", "robot", "section"}));
}

TEST(Catalogue, DescribesEverySectionAJobMayHave) {
  for (auto const& section : known_sections()) {
    bool found = false;
    for (auto const& entry : catalogue()) found = found || (entry.kind == "section" && entry.name == section);
    EXPECT_TRUE(found) << section;
  }
}

TEST(Catalogue, DescribesAnEffectWithFamilyBoundsAndSignature) {
  for (auto const& entry : catalogue()) {
    if (entry.name != "stribeck") continue;
    EXPECT_EQ(entry.text,
              (std::vector<std::string>{
                  "family     reversal, velocity_law",
                  "equation   tau = s Fs exp(-(|dq| / vs)^delta)",
                  "code       friction_sign * stribeck * exp(-pow(fabs(dq) / stribeck_speed, stribeck_exponent))",
                  "parameter  stribeck in N m (N on a slide): 0 to 2 x Coulomb level",
                  "shape      stribeck_speed in rad/s (m/s on a slide): 0.002 x peak speed to 0.2 x peak speed, "
                  "logarithmic",
                  "shape      stribeck_exponent in 1: 0.5 to 2",
                  "signature  velocity, since_velocity_reversal; odd in the velocity",
                  "acts on    joint",
                  "source     Armstrong-Helouvry 1991, Control of Machines with Friction; Bittencourt, "
                  "Gunnarsson 2012",
              }));
    return;
  }
  FAIL() << "no stribeck";
}

}  // namespace catalogue_test
}  // namespace torquescope
