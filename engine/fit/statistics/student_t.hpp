#pragma once
// The value that Student's t stays below with a given chance, one-sided.
//
// Equation   Cornish-Fisher expansion about the normal quantile, off by less than 1e-3 from four degrees of freedom on;
//            below these the distribution's integral is solved
// Requires   degrees_of_freedom >= 1
// Threads    free function
// Source     Abramowitz, Stegun 1964, 26.7.5 and 26.7.1

namespace torquescope {

inline constexpr double normal_quantile_95 = 1.6448536269514722;
inline constexpr double normal_quantile_975 = 1.959963984540054;

// z: the normal quantile of the same chance
double student_t_quantile(double z, double degrees_of_freedom);

}  // namespace torquescope
