#pragma once
// How friction may turn round with the motion: a nuisance of every model, since no encoder shows what a contact does
// within a few steps of it.
//
// Equation   friction = level times a mixture of sides, from -1 to 1: the sign of the motion, kept until it has turned;
//            tanh(dq / v) of friction that creeps; Dahl, ds/dx = (1 - s sign(dx)) / D, of friction that builds up. A
//            mixture is linear in its weights, so that any of them is fitted beside any effect
// Sizes      v: 0.1 to 20 mrad/s (mm/s), or 0.1 to 10 encoder steps a second; D: half a step to 5 mrad, or 3 steps
// Shapes     a side: n samples; not the sign itself. Units: rad/s or m/s, rad or m
// Threads    pure functions
// Source     presliding and creep: Armstrong-Helouvry, Dupont, Canudas de Wit 1994, doi:10.1016/0005-1098(94)90209-7;
//            Dahl 1968, A solid friction model, The Aerospace Corporation; mixtures: Al-Bender, Lampaert, Swevers 2005,
//            doi:10.1109/TAC.2005.858676

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace torquescope {

struct StickingBounds {
  double least_creep = 0.0, most_creep = 0.0;
  double least_length = 0.0, most_length = 0.0;
};
// resolution: what the position shows
StickingBounds sticking_bounds(double resolution);

// sizes of the shapes, in the order of the sides
struct StickingSizes {
  std::vector<double> creeps{}, lengths{};
};
StickingSizes sticking_sizes(StickingBounds const& bounds);

// q, dq: of the motion; direction: its sign, kept until it has turned. Each side of n samples goes to `take`, in order
void each_sticking_side(Eigen::VectorXd const& q, Eigen::VectorXd const& dq, Eigen::VectorXd const& direction,
                        StickingBounds const& bounds, std::function<void(Eigen::VectorXd const&)> const& take);

}  // namespace torquescope
