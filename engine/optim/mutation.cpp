#include "engine/optim/mutation.hpp"

#include <cstdint>

namespace torquescope {

std::array<std::size_t, 3> pick_three_others(RandomStream& random, std::size_t n_members, std::size_t target) {
  TORQUESCOPE_EXPECT(n_members >= 4 && target < n_members);
  std::array<std::size_t, 3> picked{};
  std::array<std::size_t, 4> taken{target};  // ascending
  for (std::size_t k = 0; k < picked.size(); ++k) {
    // one of the members that are left, counted in ascending order, then moved past those already taken
    std::size_t index = random.below(static_cast<std::uint32_t>(n_members - 1 - k));
    for (std::size_t t = 0; t <= k; ++t) index += index >= taken[t] ? 1 : 0;
    picked[k] = index;
    // keep `taken` ascending (gcc 12 warns of std::sort on so short an array)
    std::size_t place = k + 1;
    for (; place > 0 && taken[place - 1] > index; --place) taken[place] = taken[place - 1];
    taken[place] = index;
  }
  return picked;
}

void mutate_rand_1(MatrixView<double const> members, std::array<std::size_t, 3> const& picked, double F,
                   std::span<double> mutant) {
  TORQUESCOPE_EXPECT(mutant.size() == members.columns());
  auto const base = members.row(picked[0]);
  auto const plus = members.row(picked[1]);
  auto const minus = members.row(picked[2]);
  for (std::size_t j = 0; j < mutant.size(); ++j) mutant[j] = base[j] + F * (plus[j] - minus[j]);
}

}  // namespace torquescope
