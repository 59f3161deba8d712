#pragma once
// Numbers as a sentence or a table cell says them: few digits, never a false precision.
//
// Digits     two significant ones, never an exponent between 1e-6 and 1e6; unknown numbers are "?"
// Threads    free functions

#include <string>

namespace torquescope {

// "0.35", "12", "-0.0038", "150"
std::string two_digits(double value);

// "0.35 N m"; small lengths, angles and times take a milli: "3.8 ms", "0.2 mrad"
std::string quantity_text(double value, std::string const& unit);

// "between 0.40 and 0.90 rad", "between 18.9 and 19.3 s": two ends of an interval, with digits enough to tell its
// width; the unit once where both have it
std::string between_text(double from, double to, std::string const& unit);

// "12.1 %" of 0.121; below one percent two digits: "0.56 %"
std::string percent_text(double share);

// "71 %": two digits; "" of an unknown share
std::string share_text(double share);

// "p < 0.005" where the p-value is only known to lie below `least`, what so many replicates can show; "p = 0.41"
// otherwise. Never zero: a bound is rounded up to one digit
std::string p_text(double p, double least);
// the same for a table: "<0.005", "0.41"
std::string p_cell(double p, double least);

}  // namespace torquescope
