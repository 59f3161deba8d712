#pragma once
// Objects of one result file, and what is absent in it: an unknown number is NaN, a text "", a list empty.
//
// Errors     those of ResultReader; 65 also where columns that belong together differ in length, or a word is unknown
// Threads    as ResultReader

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/infer/verdict/diagnosis.hpp"
#include "engine/store/result_reader.hpp"

namespace torquescope {

Error contradiction(ResultReader const& reader, std::string const& object, std::string const& reason);

class StoredObjects {
 public:
  explicit StoredObjects(ResultReader const& reader) : reader_(reader) {}

  double number(std::string const& object, std::string const& name) const;
  std::int64_t whole(std::string const& object, std::string const& name) const;
  std::string text(std::string const& object, std::string const& name) const;
  std::vector<std::string> texts(std::string const& object, std::string const& name) const;
  bool exists(std::string const& path) const { return reader_.exists(path); }

  std::vector<double> numbers(std::string const& path) const;
  std::vector<std::int64_t> whole_numbers(std::string const& path) const;
  std::vector<std::string> text_column(std::string const& path) const;

  // group/prefix_1, group/prefix_2, ... as far as they go
  std::vector<std::string> numbered(std::string const& group, std::string const& prefix) const;

  // the word's value among those an enumeration has
  template <class Choice, std::size_t Count>
  Choice choice(std::string const& given, std::array<Choice, Count> const& choices, std::string const& object) const {
    for (Choice one : choices)
      if (word(one) == given) return one;
    throw contradiction(reader_, object, "\"" + given + "\" is no word of format 1");
  }

  template <class... Columns>
  void check_same_length(std::string const& object, std::size_t length, Columns const&... columns) const {
    if (((columns.size() != length) || ...)) throw contradiction(reader_, object, "columns of different lengths");
  }

 private:
  ResultReader const& reader_;
};

}  // namespace torquescope
