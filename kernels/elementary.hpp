#pragma once
// Exponential, logarithm, power, cosine and sine of arrays: what the columns of effects are made of.
//
// Bits       the same on every instruction set, for any n and any place in the array: polynomials with fused
//            multiply-adds in one order; nothing of the system's mathematics library, so also the same on every machine
// Error      in ULP of the result; tests/unit/kernels/elementary.cpp holds these bounds against long double. Seen:
//            largest of some 1e6 arguments
// In place   every output may be the input
// Threads    free functions; do not allocate
// Source     Cody, Waite 1980 (reduction); Tang 1989 (exponential); fdlibm k_sin, k_cos (polynomials on [-pi/4, pi/4]);
//            logarithm as 2 atanh((m - 1) / (m + 1)) with its first two terms in twice the precision

#include <cstddef>

namespace torquescope::kernels {

// e^x
// Range      any x; +inf from 709.79 on, subnormal results below -708.4, 0 below -745.2; NaN of NaN
// Error      0.7 ULP (0.62 seen); 0.8 (0.77) of a subnormal result, which is rounded twice
void exponential(double const* x, std::size_t n, double* out);

// ln x
// Range      any x; -inf of 0, NaN below it; subnormal ones included
// Error      0.6 ULP (0.51 seen)
void logarithm(double const* x, std::size_t n, double* out);

// |x|^exponent, exponent finite
// Range      any x, subnormal ones included; as std::pow at 0 and infinity; NaN of NaN
// Error      0.7 ULP (0.62 seen); 0.8 (0.72) of a subnormal result, which is rounded twice
void power_of_size(double const* x, double exponent, std::size_t n, double* out);
// each with an exponent of its own, to the same bits
void power_of_size(double const* x, double const* exponents, std::size_t n, double* out);

// cos(factor x), sin(factor x) of the exact product: its rounding error is no error of the result
// Range      |factor x| <= 2^45: beyond, neighbouring doubles lie further apart than 0.007 rad and both are NaN;
//            NaN of NaN and infinity
// Error      0.9 ULP (0.77 seen), near the zeros as well
void cosine_sine_of_multiple(double factor, double const* x, std::size_t n, double* cosine, double* sine);
// each with a factor of its own, to the same bits
void cosine_sine_of_multiple(double const* factors, double const* x, std::size_t n, double* cosine, double* sine);

}  // namespace torquescope::kernels
