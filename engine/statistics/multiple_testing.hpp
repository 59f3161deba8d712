#pragma once
// Many candidates, few false names: false-discovery control over single tests and over families of tests.
//
// q          the smallest level at which the test would still be rejected by Benjamini-Hochberg: q_(i) = min_{j >= i}
//            p_(j) m / j
// Families   first which families (Simes p of each, BH over families at level q), then which members of the selected
//            ones (BH at level q * selected / families). Hierarchical q: the smallest level at which both steps find it
// Requires   p in (0, 1]; independence or positive dependence
// Threads    free functions
// Source     Benjamini, Hochberg 1995, doi:10.1111/j.2517-6161.1995.tb02031.x; Simes 1986, doi:10.1093/biomet/73.3.751;
//            Benjamini, Bogomolov 2014, section 3, doi:10.1111/rssb.12028

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace torquescope {

// in the order of p
std::vector<double> benjamini_hochberg_q(std::span<double const> p);

// combined p of one family
double simes_p(std::span<double const> p);

// in the order of p; family[i] is the family of p[i]
std::vector<double> hierarchical_q(std::span<double const> p, std::span<std::string const> family);

}  // namespace torquescope
