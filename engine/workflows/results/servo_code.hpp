#pragma once
// The model of a set of servos as C: its step, with the effects that were named, and the numbers as a job has them.
//
// Text       servo_c: a file of its own, one step of dt <= 2 ms at a time, first order in dt
//            servo_toml: [model.given] and [loop], to be written into a job
// Requires   a diagnosis whose effects are all of the drive and the gear (rollout/drive_effect.hpp)
// Errors     Error 65 where the document is damaged
// Threads    pure functions of the document (servo_json.cpp)

#include <string>

namespace torquescope {

std::string servo_c(std::string const& document);
std::string servo_toml(std::string const& document);

}  // namespace torquescope
