#pragma once
// Rows in the order of what an effect is a function of, in blocks of equal weight: leaving out one level after the
// other shows a law of another form. Blocks of time do not, since each of them has all levels.
//
// Axis       the effect's principal one; speed without its sign; the position where that is an order. None for what
//            goes with time: blocks of time are those
// Weight     half of it the effect's torque squared, half of it the rows
// Shapes     torque: of the effect, one per row; order: a permutation of the rows
// Threads    free function

#include <Eigen/Core>
#include <vector>

#include "engine/effects/effect.hpp"
#include "engine/fit/statistics/equal_blocks.hpp"
#include "engine/infer/pipeline/motion_axes.hpp"

namespace torquescope {

struct AxisBlocks {
  std::vector<Eigen::Index> order{};  // of rows, ascending along the axis; empty where there is no such axis
  std::vector<RowBlock> blocks{};     // of that order
};

// Requires   count > 0, torque.size() = rows of axes
AxisBlocks axis_blocks(Effect const& effect, MotionAxes const& axes, Eigen::VectorXd const& torque, Eigen::Index count);

}  // namespace torquescope
