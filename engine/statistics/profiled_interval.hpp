#pragma once
// How far an instant or a place can be moved before the fit notices: the interval of a parameter that no tangent
// describes.
//
// Equation   from s_0 to both sides as far as gain(s_0) - gain(s) <= 1.96^2 noise + hidden; gain(s): energy that is
//            explained with the parameter at s, all others solved for; noise: energy of a row's own noise; hidden:
//            energy that a law which is not quite the joint's may have wrong here
// Why        a load that is picked up while the joint rests, or moves at one speed, was picked up at any instant of
//            that; what is explained changes by nothing or by a jump there, and the derivative at one instant knows
//            neither
// Search     outwards in doubling steps, then by halves; never outside the bounds
// Threads    free function
// Source     profile likelihood: Venzon, Moolgavkar 1988

#include <functional>
#include <utility>

namespace torquescope {

struct ProfiledParameter {
  double value = 0.0;
  double lower = 0.0, upper = 0.0;  // bounds; a value outside moves them
  double first_step = 0.0;          // > 0
};

// -> (from, to) around the value; row_noise, hidden >= 0
std::pair<double, double> profiled_interval(ProfiledParameter const& parameter, double row_noise, double hidden,
                                            std::function<double(double)> const& gain);

}  // namespace torquescope
