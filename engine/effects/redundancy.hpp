#pragma once
// Terms that no recording can tell apart: a column equal to a combination of earlier ones on every motion.
//
// Found, not listed: the columns are evaluated on a motion that excites everything, and each one is regressed on those
// before it. So a new effect file is covered without a word here.
//
// Requires   plain terms (Effect::is_plain_term)

#include <string>
#include <vector>

#include "engine/effects/effect.hpp"

namespace torquescope {

struct Redundancy {
  std::string what;  // "coulomb_negative is redundant: coulomb_negative = offset - coulomb_positive on every motion"
  std::string help;  // "remove one of ..."
};

std::vector<Redundancy> find_redundancies(std::vector<Effect const*> const& terms);

}  // namespace torquescope
