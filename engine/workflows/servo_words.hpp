#pragma once
// The sentences of a diagnosis of many recordings: the only place that makes them.
//
// Threads    pure functions

#include <string>

#include "engine/workflows/servo_report.hpp"

namespace torquescope {

std::string word(ServoNote note);                    // "one_load"
std::string sentence_of(ServoRemark const& remark);  // for people
// "partly explained: speed limit of the command, 4.91 rad/s; ..."
std::string headline(ServoReport const& report);
// "0.0117", "rad/s" of "loop_goal_speed_limit": without the prefix of the section
std::string name_of_number(LoopNumber const& number);

}  // namespace torquescope
