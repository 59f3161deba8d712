#include "engine/fit/optim/make_choice.hpp"

#include <fmt/format.h>

namespace torquescope {

void refuse_few_members(Section const& section, std::int64_t population, std::vector<Problem>& problems) {
  if (population == 0 || population >= fewest_members) return;
  problems.push_back(
      problem_at(section, "population", fmt::format("population = {} is out of range", population),
                 fmt::format("write {} or more, or 0 for what the method's source recommends", fewest_members)));
}

}  // namespace torquescope
