#pragma once
// An OptimiserChoice from an option table and a function that makes a search; used by the files of optimisers/.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/fit/optim/optimiser.hpp"

namespace torquescope {

using MakeSearch = std::function<std::unique_ptr<Optimiser>(Bounds const&, RandomKey)>;

// members by number of parameters, as the source of a method recommends
using UsualMembers = std::size_t (*)(std::size_t dimension);

// 0: as many as usual
inline std::size_t members_of(std::int64_t population, UsualMembers usual, std::size_t dimension) {
  return population > 0 || !usual ? static_cast<std::size_t>(population) : usual(dimension);
}

constexpr std::int64_t fewest_members = 4;

// appends a problem unless the population is 0 or has members enough
void refuse_few_members(Section const& section, std::int64_t population, std::vector<Problem>& problems);

// `configure` turns checked options into the maker of a run's search; Options has a member `population`, and where the
// method has a usual number of members, 0 stands for it
template <class Options>
OptimiserChoice make_choice(std::string name, std::string title, std::string source, OptionTable<Options> const& table,
                            std::function<MakeSearch(Options const&)> configure, UsualMembers usual = nullptr) {
  OptimiserChoice choice;
  choice.name = std::move(name);
  choice.title = std::move(title);
  choice.source = std::move(source);
  choice.options = table.describe();
  choice.prepare = [&table, configure = std::move(configure), usual](Section const& section,
                                                                     std::vector<std::string> const& ignored,
                                                                     std::vector<Problem>& problems) {
    Options options;
    table.apply(section, options, problems, ignored);
    if (usual) refuse_few_members(section, options.population, problems);
    return configure(options);
  };
  choice.population_size = [usual](Section const& section, std::size_t dimension) {
    auto const* setting = section.find("population");
    return members_of(setting ? std::get<std::int64_t>(setting->value) : Options{}.population, usual, dimension);
  };
  return choice;
}

}  // namespace torquescope
