#pragma once
// The few HDF5 operations that results need; nothing outside h5*.cpp calls HDF5.
//
// Files      superblock 3 and version 2 object headers (their metadata is checksummed), no times, no file locks
// Datasets   double, int64 or text of fixed length; rows = first dimension; one number alone has shape {}
// Texts      of fixed length everywhere: HDF5 1.10 keeps variable ones in a heap without a checksum, and one flipped
//            bit there ends the reading process (a segmentation fault in H5HG_read)
// Links      hard links only: a soft or external link is refused before it is followed
// Errors     Failure with HDF5's own reason; the callers know the file and the object and make an Error of it.
//            HDF5 prints nothing. Closing never throws.
// Threads    one thread of the process at a time (Debian's HDF5 has no lock of its own)

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/store/byte_ranges.hpp"
#include "engine/store/read_file.hpp"
#include "engine/store/temp_file.hpp"

namespace torquescope::h5 {

using Shape = std::vector<std::size_t>;

class Failure : public std::runtime_error {
 public:
  explicit Failure(std::string const& reason, std::string object = "", int error_number = 0)
      : std::runtime_error(reason), object_(std::move(object)), error_number_(error_number) {}
  std::string const& object() const { return object_; }  // path inside the file; "" when the caller knows it
  int error_number() const { return error_number_; }     // errno of the disk; 0 when it was not the disk

 private:
  std::string object_;
  int error_number_;
};

// owns one HDF5 identifier of whatever kind
class Handle {
 public:
  Handle() = default;
  explicit Handle(std::int64_t id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, none)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() { close(); }
  std::int64_t id() const { return id_; }
  bool close() noexcept;  // false when HDF5 reports a failure; closing twice is fine

 private:
  static constexpr std::int64_t none = -1;
  std::int64_t id_ = none;
};

enum class Element { number, whole_number, text };

struct DatasetPlan {
  Element element = Element::number;
  Shape shape;                // {}: one value, kept in the object header
  Shape chunk;                // same rank as shape, each at most that of shape; unused when nothing is to be stored
  std::size_t text_size = 1;  // bytes of the longest text
  bool gzip = false;          // level 1, no shuffle
};

struct DatasetInfo {
  Element element = Element::number;
  Shape shape;
  Shape chunk;                // empty: not chunked
  std::size_t text_size = 0;  // bytes of one text

  std::size_t rows() const { return shape.empty() ? 1 : shape[0]; }
  std::size_t values_per_row() const;
};

// texts as HDF5 stores them: each padded with NUL to the size of the longest
struct PaddedTexts {
  explicit PaddedTexts(std::span<std::string const> texts);
  PaddedTexts(std::size_t count, std::size_t size) : size_of_one(size), bytes(count * size, '\0') {}
  std::vector<std::string> texts() const;

  std::size_t size_of_one = 1;
  std::string bytes;
};

// h5.cpp
// values: is told where the chunks of values lie; lives as long as the file is open
Handle create_file(TempFile& file, ByteRanges& values);
Handle open_file(ReadFile const& file);  // which outlives it
bool is_hdf5(ReadFile const& file);
void flush(Handle const& file);

// h5_group.cpp. "/runs/fade": steps from the root; "/" is the root itself
bool exists(Handle const& file, std::string const& path);
Handle open_object(Handle const& file, std::string const& path);
Handle open_child(Handle const& group, std::string const& name);
Handle make_groups(Handle const& file, std::string const& path);
bool is_group(Handle const& object);
std::uint64_t address(Handle const& object);                // in the file: the same for every name of one object
std::vector<std::string> child_names(Handle const& group);  // sorted by bytes

// h5_dataset.cpp
Handle create_dataset(Handle const& group, std::string const& name, DatasetPlan const& plan);
// refuses types, filters, storage and sizes that results never have, before anything is allocated
DatasetInfo describe(Handle const& dataset);
// one whole chunk as it shall lie on the disk, its filters already applied (chunk_writer.hpp); first: where it begins
void write_chunk(Handle const& dataset, Shape const& first, std::span<std::byte const> bytes);
// rows [first, first + count) of the first dimension; `values` holds count * values_per_row elements (texts: padded
// bytes)
void write_rows(Handle const& dataset, DatasetInfo const& info, std::size_t first, std::size_t count,
                void const* values);
// so many bytes behind `values` may be changed as well: with eight of them no chunk is copied (h5_chunk.cpp)
inline constexpr std::size_t spare_for_checksum = 8;
void read_rows(Handle const& dataset, DatasetInfo const& info, std::size_t first, std::size_t count, void* values,
               std::size_t spare_bytes = 0);
// h5_chunk.cpp: for read_rows(). The same from chunks of whole rows to which nothing was done but a checksum: HDF5
// copies such a chunk twice, and its checksum takes five times as long. `memory` is the type of `values`. False where
// the dataset is stored otherwise or a chunk is damaged: then HDF5 reads it, and says what is wrong
bool read_plain_chunks(Handle const& dataset, Handle const& memory, DatasetInfo const& info, std::size_t first,
                       std::size_t count, void* values, std::size_t spare_bytes);
std::vector<std::string> read_texts(Handle const& dataset, DatasetInfo const& info, std::size_t first,
                                    std::size_t count);

// h5_attribute.cpp
// what reading gives back: bool becomes 0 or 1, a table of texts a list "key = value", NUL at the end of a text is lost
OptionValue as_stored(OptionValue const& value);
void write_attribute(Handle const& object, std::string const& name, OptionValue const& value);
// int64, double, text, numbers or texts; nothing when there is no such attribute
std::optional<OptionValue> read_attribute(Handle const& object, std::string const& name);
// sorted by bytes; without those of scales, which hold addresses, and whose lists lie in a heap without checksums
std::vector<std::string> attribute_names(Handle const& object);

// h5_scale.cpp (dimension_scales.hpp)
struct ScaleUse {
  std::string dataset;  // path
  std::size_t dimension = 0;
};
bool is_about_scales(std::string const& attribute);
// the dataset at `path` is the scale `name` of these dimensions
void make_scale(Handle const& file, std::string const& path, std::string const& name,
                std::vector<ScaleUse> const& uses);
// the other way round: paths of the scales, one per dimension of the dataset at `path`
void write_scales(Handle const& file, std::string const& path, std::vector<std::string> const& scales);

// for h5*.cpp
Handle property_list(std::int64_t kind);
Handle text_type(std::size_t size);
// throws Failure with HDF5's innermost reason
[[noreturn]] void fail(std::string const& doing);
std::int64_t checked(std::int64_t result, char const* doing);
// a hostile header may claim any size: believe no more than gzip can squeeze into the file's bytes (1032 to 1)
void check_claimed_size(Handle const& object, double bytes);

}  // namespace torquescope::h5
