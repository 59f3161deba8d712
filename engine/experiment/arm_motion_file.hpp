#pragma once
// A motion of an arm as a file of samples: what `excite` writes and [simulate.reference] file reads.
//
// Columns    t_s, then of each joint j from 1: qj_rad, dqj_rad_s, ddqj_rad_s2 (a slide: m in place of rad). Equal
//            steps; the last sample is the first one again, so that the motion can be repeated
// Errors     Error 66 (no such file), 65 (no table, unequal steps), 78 (a column that is missing)

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/fit/excite/fourier_motion.hpp"
#include "engine/robot/serial_chain.hpp"
#include "engine/simulate/sampled_reference.hpp"

namespace torquescope {

// one motion a joint. section: where the job names the file
std::vector<SampledMotion> read_arm_motion(std::filesystem::path const& file, SerialChain const& chain,
                                           Section const& section);

// comment: lines that begin with '#', or nothing
std::string arm_motion_text(MotionSamples const& samples, SerialChain const& chain, std::string const& comment);

}  // namespace torquescope
