#pragma once
// How unusual a statistic of the data is among the same statistic of its replicates: the null of every claim.
//
// Shapes     replicates: one value per replicate, M of them
// p          empirical: (1 + number of replicates at or above) / (M + 1), valid for any M
// z          (data - mean) / (spread * sqrt(1 + 1/M)); a replicate's own z is made without it,
// standardised_replicates()
// Requires   larger is more unusual; M >= 2; finite values
// Threads    free functions
// Source     Davison, Hinkley 1997, section 4.2, doi:10.1017/CBO9780511802843

#include <cstddef>
#include <span>
#include <vector>

namespace torquescope {

double empirical_p(double data, std::span<double const> replicates);
double replicate_z(double data, std::span<double const> replicates);

// z of each replicate against the others (closed form): what the maximum over several statistics must be compared with.
// In-sample z are too small by up to sqrt(M / (M - 1)) and more for outliers, which makes any scan look significant.
std::vector<double> standardised_replicates(std::span<double const> replicates);

}  // namespace torquescope
