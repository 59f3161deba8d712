#include "engine/diagnose/multiple_testing.hpp"

#include <algorithm>
#include <numeric>

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

// indices of the values, smallest first; ties in their given order
std::vector<std::size_t> order_of(std::span<double const> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

}  // namespace

std::vector<double> benjamini_hochberg_q(std::span<double const> p) {
  auto const order = order_of(p);
  auto const m = static_cast<double>(p.size());
  std::vector<double> q(p.size());
  double smallest = 1.0;
  for (std::size_t rank = order.size(); rank-- > 0;) {
    smallest = std::min(smallest, p[order[rank]] * m / static_cast<double>(rank + 1));
    q[order[rank]] = smallest;
  }
  return q;
}

double simes_p(std::span<double const> p) {
  TORQUESCOPE_EXPECT(!p.empty());
  auto const q = benjamini_hochberg_q(p);
  return *std::min_element(q.begin(), q.end());
}

std::vector<FamilyTest> hierarchical_test(std::span<double const> p, std::span<std::string const> family,
                                          double level) {
  TORQUESCOPE_EXPECT(p.size() == family.size());
  std::vector<FamilyTest> tests;
  std::vector<std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < p.size(); ++i) {
    auto const known =
        std::find_if(tests.begin(), tests.end(), [&](FamilyTest const& test) { return test.family == family[i]; });
    if (known == tests.end()) {
      tests.push_back({family[i]});
      members.push_back({i});
    } else {
      members[static_cast<std::size_t>(known - tests.begin())].push_back(i);
    }
  }
  auto const p_of = [&](std::vector<std::size_t> const& indices) {
    std::vector<double> values;
    for (std::size_t i : indices) values.push_back(p[i]);
    return values;
  };

  // which families
  std::vector<double> family_p;
  for (std::size_t f = 0; f < tests.size(); ++f) family_p.push_back(tests[f].p = simes_p(p_of(members[f])));
  auto const family_q = benjamini_hochberg_q(family_p);
  std::size_t selected = 0;
  for (std::size_t f = 0; f < tests.size(); ++f) {
    tests[f].q = family_q[f];
    tests[f].selected = family_q[f] <= level;
    selected += tests[f].selected ? 1 : 0;
  }

  // which members of the selected ones, at a level that pays for the selection
  double const member_level =
      level * static_cast<double>(selected) / static_cast<double>(std::max<std::size_t>(1, tests.size()));
  for (std::size_t f = 0; f < tests.size(); ++f) {
    if (!tests[f].selected) continue;
    auto const q = benjamini_hochberg_q(p_of(members[f]));
    for (std::size_t k = 0; k < q.size(); ++k)
      if (q[k] <= member_level) tests[f].rejected.push_back(members[f][k]);
  }
  return tests;
}

}  // namespace torquescope
