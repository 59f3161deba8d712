// Our DE/rand/1/bin and pagmo2's on the seed's problem: the same algorithm must converge at the same pace.
//
// pagmo's de, variant 7, is rand/1/bin; it draws parameters outside the box anew (our repair = "random"), starts
// uniform in the box, and accepts ties. Two things differ: its random numbers, and that its three members may include
// the target (de.cpp draws them from the whole population), which makes it a little slower: 1.4 times the gap at
// generation 100.

#include <gtest/gtest.h>

#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/types.hpp>

#include "engine/fit/optim/bound_repair.hpp"
#include "engine/fit/optim/crossover.hpp"
#include "engine/fit/optim/generational_search.hpp"
#include "engine/fit/optim/mutation.hpp"
#include "run_medians.hpp"

namespace torquescope::testing {
namespace {

// copied into every pagmo population, so it holds everything by value
struct PagmoJoint {
  LinearJoint joint = make_linear_joint();
  pagmo::vector_double fitness(pagmo::vector_double const& b) const { return {joint.mse(b)}; }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(4, -1.0), pagmo::vector_double(4, 1.0)};
  }
};

Gaps pagmo_gaps(int runs) {
  pagmo::problem const problem{PagmoJoint{}};
  auto const& joint = problem.extract<PagmoJoint>()->joint;
  constexpr unsigned rand_1_bin = 7;
  constexpr double never_stop = 0.0;
  Gaps gaps;
  for (int run = 0; run < runs; ++run) {
    pagmo::population population(problem, 30, static_cast<unsigned>(run));
    int generation = 0;
    for (std::size_t m = 0; m < milestones.size(); ++m) {
      auto const more = static_cast<unsigned>(milestones[m] - generation);
      unsigned const seed = static_cast<unsigned>(1000 + 10 * run) + static_cast<unsigned>(m);
      pagmo::algorithm const de(pagmo::de(more, 0.5, 0.9, rand_1_bin, never_stop, never_stop, seed));
      population = de.evolve(population);
      generation = milestones[m];
      gaps[m].push_back(joint.gap(population.champion_x()));
    }
  }
  for (auto& at_milestone : gaps) std::sort(at_milestone.begin(), at_milestone.end());
  return gaps;
}

// DE whose base and difference members may be the target itself, as pagmo's selection of indices allows
class DeWithPagmosPicks final : public GenerationalSearch {
 public:
  explicit DeWithPagmosPicks(RandomKey key) : GenerationalSearch("pagmo", cube(4, -1.0, 1.0), key, 30) {}

 private:
  void make_trials(TrialStreams const& streams, MatrixView<double> const& trials) const override {
    for (std::size_t member = 0; member < batch_size(); ++member) {
      RandomStream random(streams.key, streams.generation, static_cast<std::uint32_t>(member));
      auto const trial = trials.row(member);
      // three different members of all: as if the target were a member beyond the last
      mutate_rand_1(population(), pick_three_others(random, batch_size() + 1, batch_size()), 0.5, trial);
      cross_binomial(random, 0.9, population().row(member), trial);
      repair_bounds(BoundRepair::random, bounds(), population().row(member), random, trial);
    }
  }
  void learn(Selected const&, Progress&) override {}
};

void print(char const* name, Medians const& medians) {
  std::printf("%-24s %.2e %.2e %.2e %.2e\n", name, medians[0], medians[1], medians[2], medians[3]);
}

// factors asked for beforehand; the start of a search has less spread than its end
TEST(De, ConvergesAtThePaceOfPagmos) {
  constexpr int runs = 300;
  auto const pagmos = medians_of(pagmo_gaps(runs));
  auto const ours = medians_of(
      gaps_of(make_linear_joint(), "de", {{"population", std::int64_t{30}}, {"repair", std::string("random")}}, runs));
  print("pagmo", pagmos);
  print("ours", ours);
  for (std::size_t m = 0; m < milestones.size(); ++m) {
    double const factor = milestones[m] == 100 ? 10.0 : 3.0;
    EXPECT_LT(ours[m], factor * pagmos[m]) << "generation " << milestones[m];
    EXPECT_GT(ours[m], pagmos[m] / factor) << "generation " << milestones[m];
  }
}

// what is left between the two is a single rule: with it copied, the medians cannot be told apart
TEST(De, DiffersFromPagmosOnlyInKeepingTheTargetOutOfTheMutation) {
  constexpr int runs = 1000;
  auto const pagmos = pagmo_gaps(runs);
  auto const copied = gaps_of(
      make_linear_joint(), [](RandomKey key) { return std::make_unique<DeWithPagmosPicks>(key); }, runs);
  print("pagmo", medians_of(pagmos));
  print("ours with pagmo's picks", medians_of(copied));
  for (std::size_t m = 0; m < milestones.size(); ++m) {
    auto const peers = median_interval(pagmos[m]);
    auto const ours = median_interval(copied[m]);
    EXPECT_LT(ours.low, peers.high) << "generation " << milestones[m];
    EXPECT_GT(ours.high, peers.low) << "generation " << milestones[m];
    // narrow enough to mean something
    EXPECT_LT(ours.high / ours.low, 2.0);
  }
}

}  // namespace
}  // namespace torquescope::testing
