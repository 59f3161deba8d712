#pragma once
// Reads a result file (RESULT_FORMAT.md) and trusts nothing that it has not checked.
//
// Checked    at opening: regular file, the seal of its bytes before HDF5 sees them (file_seal.hpp), HDF5, ours,
//            complete, format not newer; at each object: the checksum of its header, and of each chunk of values; type;
//            size against that of the file, before memory is taken. Links to elsewhere are refused. verify_result()
//            reads everything and compares content_sha256: it also notices what another program changed on purpose.
// Errors     Error 66 when there is no such file; 74 when the disk cannot read it; 65 when anything above does not hold
//            (the message names the dataset), or what the format promises is missing
// Threads    one at a time, and nothing else in the process may use HDF5 meanwhile

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/store/file_digest.hpp"
#include "engine/store/h5.hpp"
#include "engine/store/read_file.hpp"

namespace torquescope {

class ResultReader {
 public:
  struct Numbers {
    h5::Shape shape;             // {}: one number alone
    std::vector<double> values;  // row-major
  };
  struct WholeNumbers {
    h5::Shape shape;
    std::vector<std::int64_t> values;
  };

  explicit ResultReader(FilePlace const& place);

  bool exists(std::string const& path) const;
  std::vector<std::string> children(std::string const& group) const;  // names sorted by bytes

  // of a dataset, whatever it holds; its values are not read
  h5::Shape shape(std::string const& path) const;
  h5::DatasetInfo layout(std::string const& path) const;
  Numbers numbers(std::string const& path) const;
  WholeNumbers whole_numbers(std::string const& path) const;
  // rows [first, first + count) of the first dimension alone; 65 when there are fewer
  std::vector<double> number_rows(std::string const& path, std::size_t first, std::size_t count) const;
  std::vector<std::int64_t> whole_number_rows(std::string const& path, std::size_t first, std::size_t count) const;
  // the same into memory that is there, of as many values; so many bytes behind it may be changed (h5::read_rows)
  void read_rows(std::string const& path, std::size_t first, std::size_t count, std::span<double> to,
                 std::size_t spare_bytes = 0) const;
  void read_rows(std::string const& path, std::size_t first, std::size_t count, std::span<std::int64_t> to,
                 std::size_t spare_bytes = 0) const;
  std::vector<std::string> texts(std::string const& path) const;
  std::vector<std::string> text_rows(std::string const& path, std::size_t first, std::size_t count) const;

  // Value: double (also from a whole number), std::int64_t, std::string, std::vector<double>, std::vector<std::string>
  template <class Value>
  Value attribute(std::string const& object_path, std::string const& name) const;
  template <class Value>
  std::optional<Value> find_attribute(std::string const& object_path, std::string const& name) const;
  std::vector<std::string> attribute_names(std::string const& object_path) const;

  std::filesystem::path const& name() const { return open_.path(); }
  std::uint64_t bytes() const { return open_.size(); }
  std::string content_sha256() const;  // as the writer stored it

  // every value and attribute of a part, whatever its digest is
  ReadFacts read_everything(FilePart part) const;
  // reads everything; throws unless it is what was written
  ReadFacts verified_content() const;
  // throws when the file promises a seal at its end, and has none
  void expect_seal() const;
  // both; returns content_sha256
  std::string verify() const;

 private:
  template <class Read>
  auto guarded(std::string const& object, Read&& read) const;
  h5::Handle const& object(std::string const& path) const;

  struct OpenObject {
    std::string path;  // "": none
    h5::Handle handle;
  };

  ReadFile open_;
  h5::Handle file_;
  // asked for last, and the group that it is in: the next is mostly the same or beside it, and each step from the root
  // costs more than a small dataset
  mutable OpenObject group_, object_;
};

// opens and reads all of it: exit code 65 when one bit of the content has changed
std::string verify_result(std::filesystem::path const& name);

}  // namespace torquescope
