#pragma once
// exp, log and the normal quantile with the same last bit on every machine: libm's may differ between versions.
//
// Only + - * / and sqrt in a fixed order (IEEE 754, no contraction); used wherever a rounded bit could change a
// decision of an optimiser or a simulated recording.
//
// Range      portable_exp: any x (underflows to 0, overflows to inf); portable_log: x > 0, normal numbers
// Error      both at most 2 ULP on the tested range (tests/unit/base/portable_math.cpp)
// Source     normal_quantile: Wichura, Algorithm AS 241 (PPND16), relative error about 1e-16

namespace torquescope {

double portable_exp(double x);
double portable_log(double x);
// inverse of the standard normal cumulative distribution, 0 < p < 1; of many: kernels/normal_quantiles.hpp
double normal_quantile(double probability);

}  // namespace torquescope
