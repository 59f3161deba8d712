// Loads side by side have on every instruction set the bits of one alone, in contact, in the gap and where they change.

#include "engine/effects/loads_behind_gap.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "unit/kernels/every_instruction_set.hpp"

namespace torquescope::load_behind_gap {
namespace loads_behind_gap_test {

class LoadsBehindGap : public kernels::EveryInstructionSet {};

constexpr std::size_t lanes = 19;  // no whole number of vectors

// every lane's motor swings in its own way
struct Instant {
  std::array<double, lanes> time_s{}, q{}, dq{}, ddq{}, nothing{};

  explicit Instant(double t) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      double const slow = 7.0 + static_cast<double>(lane), fast = 31.0 - static_cast<double>(lane);
      time_s[lane] = t;
      q[lane] = 0.3 * std::sin(slow * t) + 0.01 * std::sin(fast * t);
      dq[lane] = 0.3 * slow * std::cos(slow * t) + 0.01 * fast * std::cos(fast * t);
      ddq[lane] = -0.3 * slow * slow * std::sin(slow * t) - 0.01 * fast * fast * std::sin(fast * t);
    }
  }
  JointStates states() const {
    auto const of = [](std::array<double, lanes> const& values) {
      return JointStates::Quantity(values.data(), static_cast<Eigen::Index>(lanes));
    };
    return {of(time_s), of(q), of(dq), of(ddq), of(nothing), of(nothing)};
  }
};

// how many of the answers are those of a load that is not pushed
std::size_t expect_bits_of_one_alone(double film_per_s, double drag, JointScales const& scales) {
  LoadBehindGap const fresh(2e-3, 40.0, 0.1, film_per_s, drag, scales);
  auto const together = loads_behind_gap(fresh, lanes);
  std::vector<LoadBehindGap> alone(lanes, fresh);
  Eigen::ArrayXXd const inertia = Eigen::ArrayXXd::Constant(static_cast<Eigen::Index>(lanes), 1, 0.7);
  std::size_t in_gap = 0;
  for (int k = 0; k < 2000; ++k) {
    double const step_s = k % 3 == 0 ? 1e-3 : 2.5e-3;  // one sub-step, and several
    Instant const at(2e-3 * k);
    auto const states = at.states();
    together->advance(states, step_s);
    std::vector<double> found(lanes);
    together->torques(states, inertia, found);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      auto const state = states.state(lane);
      if (k == 0)
        alone[lane].start(state);
      else
        alone[lane].advance(state, step_s);
      EXPECT_EQ(found[lane], 0.7 * alone[lane].row(state)[0]) << "lane " << lane << ", step " << k;
      if (found[lane] != 0.7 * alone[lane].row(state)[0]) return 0;
      in_gap += alone[lane].load().side == 0.0 ? 1 : 0;
    }
  }
  return in_gap;
}

TEST_P(LoadsBehindGap, HaveTheBitsOfOneAlone) {
  JointScales heavy;
  heavy.inertia = 0.4;
  heavy.viscous = 0.8;
  heavy.gravity_sin = 3.0;
  heavy.gravity_cos = -1.0;
  JointScales dry = heavy;
  dry.coulomb_positive = 2.0;
  dry.coulomb_negative = 1.5;
  for (auto const& [film, drag] : {std::pair{0.0, 0.0}, std::pair{30.0, 0.0}, std::pair{5.0, 1.5}})
    for (JointScales const& scales : {JointScales{}, heavy, dry}) {
      std::size_t const in_gap = expect_bits_of_one_alone(film, drag, scales);
      EXPECT_GT(in_gap, 200u);
      EXPECT_LT(in_gap, 2000u * lanes - 200u);
    }
}

INSTANTIATE_TEST_SUITE_P(Target, LoadsBehindGap, testing::ValuesIn(kernels::supported_instruction_sets()),
                         kernels::instruction_set_of);

}  // namespace loads_behind_gap_test
}  // namespace torquescope::load_behind_gap
