#pragma once
// Many candidates, few false names: false-discovery control over single tests and over families of tests.
//
// q          the smallest level at which the test would still be rejected by Benjamini-Hochberg: q_(i) = min_{j >= i}
//            p_(j) m / j
// Families   first which families (Simes p of each, BH over families at level q), then which members of the selected
//            ones (BH at level q * selected / families): the expected average of false discoveries over selected
//            families is at most q. The hierarchical q of a member is the smallest level at which both steps find it
// Requires   p in (0, 1]; independence or positive dependence, which statistics of one residual have in good
//            approximation
// Threads    free functions
// Source     Benjamini, Hochberg 1995; Simes 1986; Benjamini, Bogomolov 2014 (JRSS B 76) section 3

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
