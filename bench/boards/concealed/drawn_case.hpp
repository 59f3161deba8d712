#pragma once
// A drawn case from its name: the rig, the motions, what is concealed and how large.
//
// Size       the rig is drawn anew, up to most_draws times, until every effect reaches its size at an amplitude that
//            real joints have; after that the nearest is kept and the truth says its size
// Same name  same case, to the bit

#include "concealed/case_list.hpp"
#include "concealed/drawn_name.hpp"

namespace concealed {

inline constexpr int most_draws = 6;

// `again`: the rig, the motions and the noises that the same name has when it is drawn anew (exact_case.hpp)
Case drawn_case(DrawnName const& name, int again = 0);

}  // namespace concealed
