#include "engine/diagnose/neighbour_load.hpp"

#include <algorithm>
#include <cmath>

#include "engine/data/levels.hpp"
#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/fit/statistics/forward_columns.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index columns_of_a_joint = 13;
constexpr std::size_t n_chosen = 2;

Motion motion_of(Recording const& recording, RecordPipeline const& pipeline, Eigen::Index other) {
  Recording alone;
  alone.name = recording.name;
  alone.rate_hz = recording.rate_hz;
  alone.time_s = recording.time_s;
  alone.torque = recording.torque;
  alone.position = recording.other_positions.col(other);
  return pipeline.motion_of(alone);
}

Eigen::MatrixXd library_of(Motion const& joint, Motion const& other) {
  auto const q = joint.q.array(), dq = joint.dq.array(), ddq = joint.ddq.array();
  auto const p = other.q.array(), dp = other.dq.array(), ddp = other.ddq.array();
  Eigen::MatrixXd columns(joint.q.size(), columns_of_a_joint);
  columns << ddp, dp * dp, dq * dp, p.cos(), p.sin(), (q + p).cos(), (q + p).sin(), (q - p).cos(), (q - p).sin(),
      ddp * p.cos(), ddp * p.sin(), ddq * p.cos(), ddq * p.sin();
  return columns;
}

// beside a model
Eigen::MatrixXd effects_of_the_joint_alone(Motion const& joint) {
  auto const q = joint.q.array(), dq = joint.dq.array();
  Eigen::MatrixXd columns(joint.q.size(), 7);
  columns << q, q.square(), q.cube(), q.cos(), q.sin(), dq.abs() * dq, dq.sign() * dq.abs().sqrt();
  return columns;
}

}  // namespace

std::optional<NeighbourLoad> neighbour_load(Recording const& recording, RecordPipeline const& pipeline,
                                            ProcessedRecord const& rows) {
  Eigen::VectorXd const& torque = rows.torque;
  Eigen::MatrixXd const& model = rows.columns;
  Eigen::Index const others = recording.other_positions.cols();
  if (others == 0 || torque.size() < fewest_rows) return std::nullopt;

  Eigen::MatrixXd library(torque.size(), others * columns_of_a_joint);
  for (Eigen::Index other = 0; other < others; ++other)
    library.middleCols(other * columns_of_a_joint, columns_of_a_joint) =
        pipeline.filtered_columns(library_of(rows.motion, motion_of(recording, pipeline, other)), rows);

  // of a column that is one number with the model nothing is known
  double const own = std::sqrt(1.0 - levels::one_number * levels::one_number);
  Eigen::Index const guard = guard_rows(pipeline);
  auto const with = [&](Eigen::MatrixXd const& columns) {
    return forward_residuals(torque, columns, library, n_chosen, own, guard);
  };
  Eigen::MatrixXd const alone = pipeline.filtered_columns(effects_of_the_joint_alone(rows.motion), rows);
  Eigen::MatrixXd joint(torque.size(), model.cols() + alone.cols());
  joint << model, alone;
  NeighbourLoad load;
  load.gain = held_out_gain(held_out_blocks(blocked_residuals(torque, joint, guard), with(joint), guard));
  load.relerr = with(model).norm() / rows.whole_torque().norm();
  for (Eigen::Index const k : forward_columns(torque, model, library, n_chosen, own)) {
    auto const& column = recording.other_columns[static_cast<std::size_t>(k / columns_of_a_joint)];
    if (std::find(load.columns.begin(), load.columns.end(), column) == load.columns.end())
      load.columns.push_back(column);
  }
  return load;
}

}  // namespace torquescope
