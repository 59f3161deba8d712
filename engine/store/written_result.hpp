#pragma once
// What a result that was written just now says in its attributes and small arrays, without reading it: its tables need
// no more.
//
// Use        asked like a ResultReader, and with its answers. What was not kept (arrays above 64 KiB, and everything
//            above 1 MiB together) is read from the file, which must have its final name by then
// Errors     those of ResultReader where it reads; 65 for what is not there
// Threads    one at a time, and nothing else in the process may use HDF5 meanwhile

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/store/result_reader.hpp"

namespace torquescope {

class WrittenResult {
 public:
  explicit WrittenResult(std::filesystem::path final_name) : name_(std::move(final_name)) {}

  // a group, or a dataset of which nothing but its shape is kept
  void keep_object(std::string const& path, h5::Shape const& shape = {});
  // value: as the file gives it back (h5::as_stored)
  void keep_attribute(std::string const& path, std::string const& name, OptionValue value);
  // of datasets whose object is kept
  void keep_numbers(std::string const& path, std::span<double const> values);
  void keep_texts(std::string const& path, std::vector<std::string> texts);

  bool exists(std::string const& path) const { return objects_.contains(path); }
  h5::Shape shape(std::string const& path) const;
  ResultReader::Numbers numbers(std::string const& path) const;
  std::vector<std::string> texts(std::string const& path) const;
  // Value: double (also from a whole number), std::int64_t, std::string, std::vector<double>, std::vector<std::string>
  template <class Value>
  std::optional<Value> find_attribute(std::string const& object_path, std::string const& name) const {
    auto const found = find_value(object_path, name, OptionValue(Value{}));
    return found ? std::optional(std::get<Value>(*found)) : std::nullopt;
  }
  template <class Value>
  Value attribute(std::string const& object_path, std::string const& name) const {
    return std::get<Value>(value(object_path, name, OptionValue(Value{})));
  }
  std::filesystem::path const& name() const { return name_; }
  std::string content_sha256() const { return attribute<std::string>("/", content_digest_key); }

 private:
  struct Object {
    h5::Shape shape;
    std::optional<std::vector<double>> numbers;
    std::optional<std::vector<std::string>> texts;
    std::map<std::string, OptionValue> attributes;
  };

  Object const& object(std::string const& path) const;
  std::optional<OptionValue> find_value(std::string const& path, std::string const& name,
                                        OptionValue const& wanted) const;
  OptionValue value(std::string const& path, std::string const& name, OptionValue const& wanted) const;
  bool has_room(std::size_t bytes);

  std::filesystem::path name_;
  std::map<std::string, Object> objects_;
  std::size_t kept_bytes_ = 0;  // of arrays
};

}  // namespace torquescope
