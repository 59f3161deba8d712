#pragma once
// The angle of one turn in rad.

#include <numbers>

namespace concealed {

inline constexpr double one_turn = 2.0 * std::numbers::pi;

}  // namespace concealed
