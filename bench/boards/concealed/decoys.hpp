#pragma once
// Faults of measurement that are no physics of the joint, and rigs out of the ordinary.
//
// Decoys     encoder (coarser than its digits), stamps (rows at nominal times, ticks that wander), late, filter and
//            hold (the torque channel)
// Regimes    noise (twice that of the worst ordinary rig), gains (loop tuned for another joint, a tenth off), encoder
//            (steps that divide no turn, last bit without meaning)
// Errors     std::invalid_argument for an unknown kind

#include <string>
#include <vector>

#include "concealed/noise.hpp"
#include "concealed/rig.hpp"

namespace concealed {

std::vector<std::string> const& decoys();
std::vector<std::string> const& wrong_regimes();
void put_decoy(Rig& rig, std::string const& kind, Random& random);
void put_wrong_regime(Rig& rig, std::string const& kind, Random& random);

// effects whose names are no claim about mechanics
std::vector<std::string> const& measurement_names();

}  // namespace concealed
