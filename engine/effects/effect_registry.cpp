#include "engine/effects/effect.hpp"

namespace torquescope {

namespace effects {
#define TORQUESCOPE_CHOICE(name) Effect const& name();
#include "effect_choices.inc"
#undef TORQUESCOPE_CHOICE
}  // namespace effects

std::vector<Effect const*> const& effect_choices() {
  static std::vector<Effect const*> const choices{
#define TORQUESCOPE_CHOICE(name) &effects::name(),
#include "effect_choices.inc"
#undef TORQUESCOPE_CHOICE
  };
  return choices;
}

Effect const* find_effect(std::string const& name) {
  for (auto const* effect : effect_choices())
    if (effect->name() == name) return effect;
  return nullptr;
}

}  // namespace torquescope
