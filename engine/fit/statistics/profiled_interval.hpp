#pragma once
// The interval of an instant or a place, which no tangent describes: how far it can move before the fit notices.
//
// Equation   from s_0 to both sides as far as gain(s_0) - gain(s) <= 1.96^2 noise + hidden; gain(s): energy explained
//            with the parameter at s, all others solved for; noise: energy of a row's own noise; hidden: energy that a
//            slightly wrong effect may have wrong here
// Search     outwards in doubling steps, then by halves; never outside the bounds
// Threads    free function
// Source     profile likelihood: Venzon, Moolgavkar 1988, doi:10.2307/2347496

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
