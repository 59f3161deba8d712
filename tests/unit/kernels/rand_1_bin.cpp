// A population's DE/rand/1/bin trials at once are those of the equations, draw by draw, on every instruction set.
#include "kernels/rand_1_bin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::kernels {
namespace rand_1_bin_test {

class Rand1BinTargets : public EveryInstructionSet {};

INSTANTIATE_TEST_SUITE_P(Target, Rand1BinTargets, testing::ValuesIn(supported_instruction_sets()), instruction_set_of);

// draws of one member's stream, one after the other, out of blocks that philox.cpp compares with Random123
class Draws {
 public:
  Draws(PhiloxStreams streams, std::size_t member, std::size_t n_draws) : words_(4 * ((n_draws + 1) / 2)) {
    streams.first_word_1 += static_cast<std::uint32_t>(member);
    philox_blocks(streams, 1, 0, words_.size() / 4, words_.data());
  }

  std::uint64_t below(std::uint64_t n) {
    next_ += 2;
    return (words_[next_ - 1] * n) >> 32;
  }
  double uniform() {
    next_ += 2;
    std::uint64_t const bits = (std::uint64_t{words_[next_ - 1]} << 32) | words_[next_ - 2];
    return static_cast<double>(bits >> 11) * 0x1.0p-53;
  }
  // one of those that are not in `taken`, by their rank among these
  std::size_t another(std::size_t n_members, std::vector<std::size_t>& taken) {
    std::size_t rank = below(n_members - taken.size()), member = 0;
    for (;; ++member) {
      if (std::find(taken.begin(), taken.end(), member) != taken.end()) continue;
      if (rank-- == 0) break;
    }
    taken.push_back(member);
    return member;
  }

 private:
  std::vector<std::uint32_t> words_;
  std::size_t next_ = 0;
};

struct Problem {
  std::vector<double> members, lower, upper;
  Rand1Bin population;

  Problem(std::mt19937& random, std::size_t n_members, std::size_t dimension, double F, double CR) {
    std::uniform_real_distribution<double> inside(-1.0, 1.0);
    members.resize(n_members * dimension);
    std::generate(members.begin(), members.end(), [&] { return inside(random); });
    lower.assign(dimension, -1.0);
    upper.assign(dimension, 1.0);
    population = {n_members, dimension, members.data(), lower.data(), upper.data(), F, CR};
  }
};

void expect_trial(Rand1Bin const& population, PhiloxStreams const& streams, std::size_t target, double const* trial,
                  std::uint8_t outside) {
  std::size_t const dimension = population.dimension;
  Draws draws(streams, target, 4 + dimension);
  std::vector<std::size_t> taken{target};
  double const* const base = population.members + draws.another(population.n_members, taken) * dimension;
  double const* const plus = population.members + draws.another(population.n_members, taken) * dimension;
  double const* const minus = population.members + draws.another(population.n_members, taken) * dimension;
  std::size_t const j_rand = draws.below(dimension);
  bool left = false;
  for (std::size_t j = 0; j < dimension; ++j) {
    bool const from_mutant = draws.uniform() < population.CR || j == j_rand;
    double const scaled = population.F * (plus[j] - minus[j]), mutant = base[j] + scaled;
    double const expected = from_mutant ? mutant : population.members[target * dimension + j];
    ASSERT_EQ(trial[j], expected) << "member " << target << ", parameter " << j;
    left = left || !(expected >= population.lower[j] && expected <= population.upper[j]);
  }
  ASSERT_EQ(outside, left ? 1 : 0) << "member " << target;
}

TEST_P(Rand1BinTargets, EqualsTheEquationsBitForBit) {
  std::mt19937 random(7);
  constexpr double untouched = -77.0;
  for (std::size_t n_members : {4, 5, 8, 9, 30, 67})
    for (std::size_t dimension : {1, 2, 3, 4, 5, 8, 11, 61})
      for (double CR : {0.0, 0.5, 0.9, 1.0}) {
        Problem const problem(random, n_members, dimension, 0.8, CR);
        std::uniform_int_distribution<std::uint32_t> word;
        PhiloxStreams const streams{{word(random), word(random)}, 0, word(random), word(random)};
        // those before and behind the targets stay as they were
        Targets const targets{n_members / 4, n_members - n_members / 2};
        std::vector<double> trials(n_members * dimension, untouched);
        std::vector<std::uint8_t> outside(targets.count + 1, 9);
        rand_1_bin_trials(problem.population, streams, targets, trials.data(), outside.data());
        for (std::size_t i = 0; i < n_members; ++i) {
          double const* const trial = trials.data() + i * dimension;
          if (i - targets.first < targets.count)
            expect_trial(problem.population, streams, i, trial, outside[i - targets.first]);
          else
            ASSERT_EQ(std::count(trial, trial + dimension, untouched), static_cast<std::ptrdiff_t>(dimension));
        }
        ASSERT_EQ(outside.back(), 9);
      }
}

TEST_P(Rand1BinTargets, FlagsInfinityAndNanAsOutside) {
  std::mt19937 random(8);
  for (double const bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Problem problem(random, 9, 3, 0.8, 1.0);
    for (double& number : problem.members) number = bad;
    std::vector<double> trials(27);
    std::vector<std::uint8_t> outside(9);
    rand_1_bin_trials(problem.population, {{1, 2}, 0, 3, 4}, {0, 9}, trials.data(), outside.data());
    EXPECT_EQ(outside, std::vector<std::uint8_t>(9, 1));
  }
}

}  // namespace rand_1_bin_test
}  // namespace torquescope::kernels
