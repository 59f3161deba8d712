#include "engine/effects/given_effect.hpp"

namespace torquescope {

namespace effects {
#define TORQUESCOPE_CHOICE(name) Effect const& name();
#include "arm_effect_choices.inc"
#include "effect_choices.inc"
#undef TORQUESCOPE_CHOICE
}  // namespace effects

std::vector<Effect const*> const& arm_effect_choices() {
  static std::vector<Effect const*> const choices{
#define TORQUESCOPE_CHOICE(name) &effects::name(),
#include "arm_effect_choices.inc"
#undef TORQUESCOPE_CHOICE
  };
  return choices;
}

std::vector<Effect const*> const& effect_choices() {
  static std::vector<Effect const*> const choices{
#define TORQUESCOPE_CHOICE(name) &effects::name(),
#include "effect_choices.inc"
#undef TORQUESCOPE_CHOICE
  };
  return choices;
}

Effect const* find_effect(std::string const& name) {
  for (auto const* choices : {&effect_choices(), &arm_effect_choices()})
    for (auto const* effect : *choices)
      if (effect->name() == name) return effect;
  return nullptr;
}

}  // namespace torquescope
