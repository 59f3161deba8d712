#pragma once
// Rows of text in aligned columns, as wide as their widest cell.
//
// Column 0 is left-aligned, the others as their Align says; columns are two spaces apart. The last column may wrap.
// Narrow      columns that the page has no room for go below the others, further in, row by row

#include <string>
#include <vector>

namespace torquescope {

class TextTable {
 public:
  enum class Align { left, right };

  TextTable(std::vector<Align> columns, std::string indent = "")
      : columns_(std::move(columns)), indent_(std::move(indent)) {}

  void row(std::vector<std::string> cells);  // missing cells are empty; more cells than columns are a broken promise
  int row_count() const { return static_cast<int>(rows_.size()); }
  // every line ends with a line feed and has no spaces before it; lines over `width` columns break in the last column
  std::string text(int width) const;

 private:
  // columns [begin, end) that stand side by side
  struct Band {
    std::size_t begin, end;
  };
  std::vector<Band> bands(std::vector<int> const& widths, int width) const;
  std::string line_of(std::vector<std::string> const& cells, Band band, std::vector<int> const& widths,
                      int width) const;

  std::vector<Align> columns_;
  std::string indent_;
  std::vector<std::vector<std::string>> rows_;
};

std::string short_number(double value);  // four significant digits: "0.0164", "-0.2582", "8.3e-12"; NaN is ""
std::string rough_number(double value);  // one digit, for gaps: "8e-12"; NaN is ""

}  // namespace torquescope
