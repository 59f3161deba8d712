#pragma once
// An OptimiserChoice from an option table and a function that makes a search; used by the files of optimisers/.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/optim/optimiser.hpp"

namespace torquescope {

using MakeSearch = std::function<std::unique_ptr<Optimiser>(Bounds const&, RandomKey)>;

// `configure` turns checked options into the maker of a run's search; Options has a member `population`
template <class Options>
OptimiserChoice make_choice(std::string name, std::string title, std::string source, OptionTable<Options> const& table,
                            std::function<MakeSearch(Options const&)> configure) {
  OptimiserChoice choice;
  choice.name = std::move(name);
  choice.title = std::move(title);
  choice.source = std::move(source);
  choice.options = table.describe();
  choice.prepare = [&table, configure = std::move(configure)](Section const& section,
                                                              std::vector<std::string> const& ignored,
                                                              std::vector<Problem>& problems) {
    Options options;
    table.apply(section, options, problems, ignored);
    return configure(options);
  };
  choice.population_size = [](Section const& section, std::size_t) {
    auto const* setting = section.find("population");
    if (!setting) return static_cast<std::size_t>(Options{}.population);
    return static_cast<std::size_t>(std::get<std::int64_t>(setting->value));
  };
  return choice;
}

}  // namespace torquescope
