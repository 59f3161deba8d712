#pragma once
// Signals of several lengths in one file, each with a vector of time stamps of that length: q, tq of 1000 values, tau,
// ttau of 250.
//
// Clock      the one column of a length that rises from value to value and whose name says time, or begins with a t
// Blocks     two lengths or more with a clock, whose stretches of time overlap in more than half of the shorter one
// Threads    free functions

#include <optional>
#include <string>
#include <vector>

#include "engine/data/recording_reader.hpp"

namespace torquescope {

// the column that is the clock of these, all of one length; none where there is no such, or more than one
std::optional<std::size_t> clock_among(std::vector<std::string> const& names,
                                       std::vector<std::vector<double>> const& columns,
                                       std::vector<std::size_t> const& block);

// whether two clocks run at the same time
bool run_together(std::vector<double> const& one, std::vector<double> const& other);

// Error 65 where a channel has another length than its clock (columns.time, or that of `clocks`)
// table: with lengths
void check_block_lengths(RawTable const& table, RecordingOptions const& options);

// the columns of one clock, that of `column`, without the NaN behind them
RawTable block_of(RawTable const& table, std::string const& column);

}  // namespace torquescope
