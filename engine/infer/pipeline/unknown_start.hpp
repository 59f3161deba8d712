#pragma once
// How many samples pass before a joint's friction depends on nothing but the record.
//
// Equation   the first sample that ends a way of 0.06 (max q - min q) without a turn: three times the longest distance
//            over which the catalogue lets friction build up (effects/presliding.cpp); a twentieth of the start is left
// Limit      none (0) where a tenth of all the way passes before that: a record of small strokes has no such start
// Use        on recording and replicates alike, each from its own filtered motion (record_pipeline.cpp)
// Shapes     q, dq: n samples at the full rate
// Units      rad or m; rad/s or m/s
// Threads    free function

#include <Eigen/Core>

namespace torquescope {

Eigen::Index unknown_start(Eigen::VectorXd const& q, Eigen::VectorXd const& dq);

}  // namespace torquescope
