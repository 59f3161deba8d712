#pragma once
// The columns of a table of records in a result file: one dataset per member, nothing for a table without rows.
//
// Use        TableColumns<Candidate>(writer, group, candidates, "candidate").texts("candidate", get, "effect")
// Dimension  what the rows are (dimension_scales.hpp); a column of that name is its scale. "": not said
// Errors     those of ResultWriter

#include <string>
#include <utility>
#include <vector>

#include "engine/store/result_writer.hpp"

namespace torquescope {

template <class Record>
class TableColumns {
 public:
  TableColumns(ResultWriter& writer, std::string group, std::vector<Record> const& records,
               std::string const& dimension = "")
      : writer_(writer), group_(std::move(group)), records_(records) {
    if (!dimension.empty()) dimensions_ = {dimension};
  }

  template <class Get>
  TableColumns& numbers(std::string const& name, Get&& get, Note const& note) {
    std::vector<double> values;
    for (auto const& record : records_) values.push_back(get(record));
    if (!values.empty()) writer_.numbers(group_ + "/" + name, {values.size()}, values, note.over(dimensions_));
    return *this;
  }
  template <class Get>
  TableColumns& texts(std::string const& name, Get&& get, std::string const& long_name) {
    std::vector<std::string> values;
    for (auto const& record : records_) values.push_back(get(record));
    if (!values.empty()) writer_.texts(group_ + "/" + name, values, Note{"1", long_name}.over(dimensions_));
    return *this;
  }

 private:
  ResultWriter& writer_;
  std::string group_;
  std::vector<Record> const& records_;
  std::vector<std::string> dimensions_{};
};

}  // namespace torquescope
