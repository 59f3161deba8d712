#pragma once
// What each file in references/ provides: make_NAME(options, duration, key).

#include <memory>

#include "engine/simulate/reference.hpp"

namespace torquescope {

#define TORQUESCOPE_CHOICE(name)                                                                   \
  std::unique_ptr<Reference const> make_##name(ReferenceOptions const& options, double duration_s, \
                                               RandomKey const& key);
#include "reference_choices.inc"
#undef TORQUESCOPE_CHOICE

}  // namespace torquescope
