#pragma once
// Lists in the cells of a delimited text, as data sets for imitation have them: "[0.01, 0.10]", [0.01 0.10].
//
// Text       a cell in square brackets with numbers, separated by commas, semicolons or blanks; quotes around it do not
//            count. Lists of lists are none
// Threads    functions of their arguments

#include <string>
#include <string_view>
#include <vector>

namespace torquescope {

// the elements, views into the cell; empty when it is no list of numbers
std::vector<std::string_view> list_elements(std::string_view cell);

// Columns that are spread into one each element: "action" -> "action[0]", "action[1]"
class ListColumns {
 public:
  explicit ListColumns(std::vector<std::string_view> const& first_row);

  bool any() const { return any_; }
  // of one text a column (a name, a unit): with [k] behind it where it is a name
  std::vector<std::string> spread_names(std::vector<std::string> const& names) const;
  std::vector<std::string> spread_units(std::vector<std::string> const& units) const;
  // a cell that is no list of as many elements stands in all of its columns, to be found there
  void spread_cells(std::vector<std::string_view>& cells) const;

 private:
  bool any_ = false;
  std::vector<std::size_t> elements_;  // of each column; 0: no list
};

}  // namespace torquescope
