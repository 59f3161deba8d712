#pragma once
// Everything that has a name and can be listed or described: effects, optimisers, readers, losses, estimators, job
// sections. Made from the registries and option tables; nothing is written twice.

#include <string>
#include <vector>

#include "engine/base/options.hpp"

namespace torquescope {

struct CatalogueEntry {
  std::string name;                          // "fade", "stribeck", "filter"
  std::string kind;                          // "optimiser", "effect", "reader", "loss", "estimator", "section", "robot"
  std::string title;                         // one line
  std::vector<std::string> text{};           // equation, source, remarks: one line each
  std::vector<OptionDescription> options{};  // keys with type, unit, range, default, meaning
};

std::vector<CatalogueEntry> const& catalogue();

}  // namespace torquescope
