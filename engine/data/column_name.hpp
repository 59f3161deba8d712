#pragma once
// A column's name taken apart: "Axis2.ActPos[Inc]" is act, pos; unit Inc; joint 2; and "axis" says nothing.
//
// Words      lower case, split at all that is no letter and where a capital follows a small letter; "qref" and "ides"
//            are two: a quantity and whether it was commanded
// Unit       of the row of units, else what stands in brackets, or the last word that is one
// Joint      the last number, or that of a repeated name ("Torque#2"); with
//            the words that say nothing ("left_arm") it tells joints of one file apart
// Threads    functions of their arguments

#include <optional>
#include <string>
#include <vector>

#include "engine/data/column_word.hpp"
#include "engine/data/unit_of_name.hpp"

namespace torquescope {

struct ColumnName {
  std::vector<ColumnWord> words;  // those that say something
  std::string rest;               // the others, joined: "left arm"
  std::string number;             // "2", or empty
  std::string unit_text;          // as written: "mA"
  std::optional<NamedUnit> unit{};
};

// units: what the file's row of units says of the column, "" without one
ColumnName parse_column_name(std::string const& name, std::string const& units = "");

// what one column holds, by its name and unit alone
struct ColumnRole {
  WordKind quantity = WordKind::doubtful;  // time .. drive; doubtful: none known
  bool commanded = false;
  int score = 0;  // how sure: the best column of a channel has the highest
};

ColumnRole column_role(ColumnName const& name);

}  // namespace torquescope
