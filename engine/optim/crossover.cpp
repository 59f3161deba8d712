#include "engine/optim/crossover.hpp"

#include <cstddef>
#include <cstdint>

#include "engine/base/contract.hpp"

namespace torquescope {

void cross_binomial(RandomStream& random, double CR, std::span<double const> target, std::span<double> mutant) {
  TORQUESCOPE_EXPECT(target.size() == mutant.size() && !target.empty());
  std::size_t const j_rand = random.below(static_cast<std::uint32_t>(mutant.size()));
  for (std::size_t j = 0; j < mutant.size(); ++j) {
    // drawn for j_rand too: draw j belongs to parameter j
    bool const from_mutant = random.uniform() < CR;
    if (!from_mutant && j != j_rand) mutant[j] = target[j];
  }
}

}  // namespace torquescope
