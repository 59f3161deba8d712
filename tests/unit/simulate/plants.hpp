#pragma once
// Joints and job sections for the tests of the simulator.

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "engine/simulate/plant_parameters.hpp"
#include "engine/simulate/simulation_plan.hpp"

namespace torquescope::test {

inline Section section(std::string name, std::initializer_list<std::pair<std::string, OptionValue>> settings = {}) {
  Section made{std::move(name), {}, {}};
  for (auto const& [key, value] : settings) made.settings.push_back({key, value});
  return made;
}

inline std::vector<PlantTerm> plant(std::initializer_list<std::pair<std::string, OptionValue>> parameters) {
  std::vector<Problem> problems;
  auto terms = read_plant(section("simulate.plant", parameters), JointKind::revolute, problems);
  if (!problems.empty()) throw Error(problems);
  return terms;
}

// the seed paper's OLS row
inline std::vector<PlantTerm> seed_plant() {
  return plant({{"inertia", 0.0036}, {"viscous", 0.0164}, {"coulomb_positive", 0.0089}, {"coulomb_negative", -0.2582}});
}

}  // namespace torquescope::test
