#pragma once
// Least squares of all joints of an arm together, from products of their columns alone.
//
// Equation   each joint weighed by its own residual, in a few passes. The torque of one joint may be known up to a
//            factor, which the others tell: the links that move it move them as well
// Shapes     a gram a joint (arm_grams.hpp); values: base parameters, frictions, then the factor
// Threads    pure functions

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/robot/arm_grams.hpp"

namespace torquescope {

struct GramUnknowns {
  std::vector<std::vector<Eigen::Index>> places;  // of each gram's columns among all unknowns
  Eigen::Index count = 0;                         // without a factor
  std::optional<Eigen::Index> scaled{};           // the gram whose torque is known up to a factor

  Eigen::Index size() const { return count + (scaled ? 1 : 0); }
  static constexpr double floor = 0.005;  // smaller errors are alike: filters and encoders leave as much
};

// base parameters first, then each joint's friction
GramUnknowns gram_unknowns(ArmRows const& rows, Eigen::Index n_base, std::optional<Eigen::Index> scaled = {});

Eigen::VectorXd fitted(std::vector<JointGram> const& grams, GramUnknowns const& unknowns);

// of one gram: its columns' values, then minus the factor of its torque
Eigen::VectorXd direction_of(GramUnknowns const& unknowns, Eigen::VectorXd const& values, Eigen::Index gram);
// mean over the rows: of what this direction leaves, and of the torque
double square_of(JointGram const& gram, Eigen::VectorXd const& direction);
double torque_square(JointGram const& gram);
void add_gram(JointGram& to, JointGram const& more);

}  // namespace torquescope
