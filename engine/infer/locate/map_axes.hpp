#pragma once
// The axes of the mismatch map: where each row of a recording lies on them and where their cells begin and end.
//
// Cells      54 for every axis. velocity, load, acceleration: equal width on either side of zero, which is an edge, so
//            that parity shows; position, time: equal width; distances since a reversal: equally populated;
//            order, frequency: wave_spectrum.hpp
// Load       sign(dq) * load torque; above zero the motor drives, below it is driven
// Shown      the mean residual of a cell; along the motion for load and distance since a velocity reversal, along the
//            model's torque for distance since a torque reversal, where it would average out otherwise
// Requires   rows away from reversals (reversal_mask.hpp), or all but rests
// Units      SI of the joint's kind
// Threads    free functions

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "engine/effects/effect_traits.hpp"
#include "engine/effects/joint_scales.hpp"
#include "engine/infer/locate/motion_axes.hpp"

namespace torquescope {

inline constexpr int n_map_cells = 54;

// fixed: an empty row of the map is evidence as well
inline constexpr std::array<SignatureAxis, 9> map_axes{SignatureAxis::velocity,
                                                       SignatureAxis::since_velocity_reversal,
                                                       SignatureAxis::since_torque_reversal,
                                                       SignatureAxis::load,
                                                       SignatureAxis::position,
                                                       SignatureAxis::acceleration,
                                                       SignatureAxis::time,
                                                       SignatureAxis::order,
                                                       SignatureAxis::frequency};

enum class CellReading { torque, along_motion, along_torque };
CellReading shown_reading(SignatureAxis axis);

constexpr bool is_spectrum(SignatureAxis axis) {
  return axis == SignatureAxis::order || axis == SignatureAxis::frequency;
}

std::string axis_unit(SignatureAxis axis, JointKind joint);

// place of every row, or sample; not for spectra
Eigen::VectorXd values_on(SignatureAxis axis, MotionAxes const& axes);

// n_map_cells + 1 edges, ascending; from the finite values
std::vector<double> cell_edges(SignatureAxis axis, Eigen::VectorXd const& values);

// cell of every row: from <= value < to, values outside go to the end cells; -1 for a value that is not finite
std::vector<int> cells_of(Eigen::VectorXd const& values, std::span<double const> edges);

}  // namespace torquescope
