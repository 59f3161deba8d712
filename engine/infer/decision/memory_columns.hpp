#pragma once
// Torque of what remembers the motion, whatever its form: columns of one strip, by how long the memory is.
//
// Equation   at each frequency f: a load on a spring that the acceleration drives, y'' + 2 z w y' + w^2 y = q'',
//            w = 2 pi f, z = 0.2, by position and speed; a slow mean m of the speed, m' = w (|q'| - m), times the
//            model's torque and times the side of dry friction
// Noise      the measured torque would not do: what it is regressed on holds the same noise
// Why        linear filters followed by functions without memory come near every torque whose memory fades
//            (Boyd, Chua 1985, doi:10.1109/TCS.1985.1085649); these are the simplest
// Shapes     n rows x 4 for each frequency; filtered and weighed as the strip's rows are
// Threads    pure functions

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/infer/decision/strip.hpp"

namespace torquescope {

// half octaves, from ten periods in the shortest strip to half of the filter's cut-off; none where that leaves none
std::vector<double> memory_frequencies(std::span<Strip const> strips);
// torque: of the model at the effects' rate
Eigen::MatrixXd memory_columns(Strip const& strip, Eigen::VectorXd const& torque, double frequency_hz);

}  // namespace torquescope
