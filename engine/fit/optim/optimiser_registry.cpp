#include "engine/fit/optim/optimiser.hpp"

namespace torquescope {

// one function per file in optimisers/, listed in CMakeLists.txt
#define TORQUESCOPE_CHOICE(name) OptimiserChoice name##_optimiser();
#include "optimiser_choices.inc"
#undef TORQUESCOPE_CHOICE

std::vector<OptimiserChoice> const& optimiser_choices() {
  static std::vector<OptimiserChoice> const all{
#define TORQUESCOPE_CHOICE(name) name##_optimiser(),
#include "optimiser_choices.inc"
#undef TORQUESCOPE_CHOICE
  };
  return all;
}

OptimiserChoice const* find_optimiser(std::string const& name) {
  for (auto const& choice : optimiser_choices()) {
    if (choice.name == name) return &choice;
  }
  return nullptr;
}

}  // namespace torquescope
