#pragma once
// What a recording cannot tell closes effects, and the rest is searched: one direction, one speed, a torque at its
// limit, a torque that the baseline hardly explains.
//
// One direction   effects that remember reversals, or differ by direction alone, show nothing there
// One speed       effects of the velocity are one with viscous and Coulomb friction; what acts at places shows all the
//                 same
// Saturated       rows at the limit are left out (saturated_samples()); the effect of clipping stays open
// No relation     what is missing may be all there is: searched, and refused only when nothing is found
// Units           as Excitation
// Threads         free functions

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/data/excitation.hpp"
#include "engine/effects/effect.hpp"
#include "engine/infer/pipeline/recording_checks.hpp"

namespace torquescope {

struct MotionLimits {
  bool has_one_direction = false, has_one_speed = false, is_saturated = false, has_no_relation = false;
};

// relerr: of the baseline on the recording it was fitted to
MotionLimits limits_of(Excitation const& facts, double relerr);

// A joint that goes one way at one speed and comes to no place twice: where it is and when it is there are one, so that
// an effect of the place, of time and of anything that starts up explain the same
std::optional<Hopeless> place_is_time(MotionLimits const& limits, Excitation const& facts, JointKind joint);

// whether the rarer direction has a fifth of the rows, which is a convention: with fewer an offset and what friction is
// in the other direction are one
bool moves_both_ways(Eigen::Ref<Eigen::VectorXd const> const& velocity);

bool closes(MotionLimits const& limits, Effect const& effect);
// "Only one speed was recorded: nothing is known of effects of the velocity." and the like, one after another; ""
std::string closed_sentences(MotionLimits const& limits, Excitation const& facts);

// where nothing was found: what the motion would have had to show; nothing where it could have shown everything
std::optional<Hopeless> blamed_for_silence(MotionLimits const& limits, Excitation const& facts, double relerr);

// Samples whose torque stands exactly at its largest or smallest value, and those that the parallel filter mixes with
// them; none where they are fewer than a twentieth of the recording
std::vector<bool> saturated_samples(Recording const& recording, double cutoff_hz);

// of a recording whose noise hides every missing torque below this share of the whole
Hopeless noise_hides(double share);

}  // namespace torquescope
