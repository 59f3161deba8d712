#pragma once
// Which column holds the time stamps of a table, in which unit, and how sure that is.
//
// Unit       of the name when the step it gives is that of a recording (10 us to 0.5 s); else of the values: stamps
//            since 1970 tell it by their size, others by their step (0.5 to 100: ms; to 1e5: us; above: ns)
// Two parts  seconds and nanoseconds are no stamps: their sum is a column of its own (ros_stamp.hpp)
// Threads    free function

#include <optional>
#include <string>
#include <vector>

#include "engine/data/recording_reader.hpp"

namespace torquescope {

enum class Certainty { sure, by_name, by_values, doubtful };

struct StampGuess {
  std::string column;
  double per_unit = 1.0;  // s
  Certainty unit = Certainty::by_name;
  std::string why{};  // "the name says ms", "a step of 2e+06 suits nanoseconds"
};

// nothing when no column with the name of a time, or the one that was named, runs forwards
std::optional<StampGuess> guess_stamps(RawTable const& table, std::string const& named = "");

}  // namespace torquescope
