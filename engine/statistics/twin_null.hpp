#pragma once
// How unusual a statistic of the data is among the same statistic of clean twins: the null of every claim.
//
// Shapes     twins: one value per twin, M of them
// p          empirical: (1 + number of twins at or above) / (M + 1), never below 1 / (M + 1), valid for any M;
//            tail: beyond the twins' upper quartile an exponential continues their empirical tail, so that a multiple
//            test over many candidates can fire; only for M >= 200, below that the empirical p is returned
// z          (data - mean) / (spread * sqrt(1 + 1/M)): the data is one more draw, not part of the mean
// Requires   larger is more unusual; M >= 2; finite values
// Threads    free functions
// Source     Davison, Hinkley: Bootstrap Methods (1997) section 4.2; Pickands 1975 for the exponential tail;
//            leave-one-out scaling: a twin's own z must be made without it, see standardised_twins()

#include <cstddef>
#include <span>
#include <vector>

namespace torquescope {

// twins from which a tail is fitted
inline constexpr std::size_t fewest_twins_for_tail = 200;

double empirical_p(double data, std::span<double const> twins);
double tail_p(double data, std::span<double const> twins);
double twin_z(double data, std::span<double const> twins);

// z of every twin against all others (closed form): what the maximum over several statistics must be compared with.
// In-sample z are too small by up to sqrt(M / (M - 1)) and more for outliers, which makes any scan look significant.
std::vector<double> standardised_twins(std::span<double const> twins);

}  // namespace torquescope
