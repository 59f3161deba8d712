#include "engine/statistics/multiple_testing.hpp"

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

struct Family {
  std::string name;
  std::vector<std::size_t> members{};  // indices into all p
  std::vector<double> p{};             // of the members
};

// in the order of their first member
std::vector<Family> families_of(std::span<double const> p, std::span<std::string const> family) {
  std::vector<Family> families;
  for (std::size_t i = 0; i < p.size(); ++i) {
    auto known =
        std::find_if(families.begin(), families.end(), [&](Family const& one) { return one.name == family[i]; });
    if (known == families.end()) known = families.insert(families.end(), {family[i]});
    known->members.push_back(i);
    known->p.push_back(p[i]);
  }
  return families;
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

std::vector<double> hierarchical_q(std::span<double const> p, std::span<std::string const> family) {
  TORQUESCOPE_EXPECT(p.size() == family.size());
  std::vector<Family> const families = families_of(p, family);
  std::vector<double> family_p;
  for (auto const& one : families) family_p.push_back(simes_p(one.p));
  std::vector<double> const family_q = benjamini_hochberg_q(family_p);
  std::vector<double> selected_from = family_q;  // [s - 1]: the level from which on s families are selected
  std::sort(selected_from.begin(), selected_from.end());

  auto const count = static_cast<double>(families.size());
  std::vector<double> q(p.size(), 1.0);
  for (std::size_t f = 0; f < families.size(); ++f) {
    std::vector<double> const inside = benjamini_hochberg_q(families[f].p);
    for (std::size_t k = 0; k < inside.size(); ++k) {
      double& best = q[families[f].members[k]];
      // with s families selected, its own among them, members are tested at level * s / count
      for (std::size_t s = 1; s <= families.size(); ++s) {
        double const level = std::max({family_q[f], selected_from[s - 1], inside[k] * count / static_cast<double>(s)});
        best = std::min(best, level);
      }
    }
  }
  return q;
}

}  // namespace torquescope
