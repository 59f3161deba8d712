#pragma once
// Identification problems as functions of a box 0 .. 1, drawn with their truth: criteria beyond least squares.
//
// huber      two links in a vertical plane, 6 base parameters, viscous and Coulomb friction of the joints (10), one
//            torque in ten an outlier, Huber's loss
// friction   viscous, Coulomb, Stribeck (level, speed, exponent), presliding (level, damping, distance), offset (9),
//            all of them searched, squares
// loop       a joint under the engine's pd controller, positions simulated anew for every candidate: inertia, viscous,
//            Coulomb, Stribeck (level, speed, exponent), gravity (7), squares of position
// bodies     the second of the two links as a body of positive density: 10 numbers of the Cholesky factor of its
//            pseudo-inertia; squares of torque and a weak pull towards a prior
// Noise      2 % of the signal's rms; the least value is above 0 and not at the truth
// Random     addressed by instance
// Source     effects: engine/effects; dynamics: engine/robot; loop: engine/simulate; divergence: pseudo_inertia.hpp

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace torquescope::bench {

struct IdentificationProblem {
  std::size_t dimension = 0;
  std::function<double(std::span<double const>)> criterion;
  std::vector<double> truth;  // in the box
};

std::vector<std::string> const& identification_names();
IdentificationProblem identification_problem(std::string const& name, std::uint32_t instance);

}  // namespace torquescope::bench
