#pragma once
// Writes rows of a dataset as whole chunks, compressed and with their checksums, as HDF5's filters would have done.
//
// Why        HDF5 copies a chunk three times and takes five times as long for its checksum. Readers see no difference.
// Requires   chunks as chunking.hpp cuts them: each is one contiguous part of the array
// Bytes      what lies beyond the dataset's end in its last chunks is 0
// Memory     a chunk, kept from one call to the next; compressed two
// Errors     those of h5.hpp
// Threads    one at a time

#include <cstddef>
#include <span>
#include <vector>

#include "engine/store/h5.hpp"

namespace torquescope {

class ChunkWriter {
 public:
  explicit ChunkWriter(bool gzip) : gzip_(gzip) {}

  // where values of a chunk can be made that write() then need not copy; they stay until it is called
  std::span<std::byte> room(std::size_t chunk_bytes);

  // rows [first, first + count), which begin with a chunk and end with one or with the dataset; row-major values
  void write(h5::Handle const& dataset, h5::DatasetInfo const& info, std::size_t first, std::size_t count,
             void const* values);

 private:
  std::span<std::byte const> encoded(std::span<std::byte const> part, std::size_t chunk_bytes);

  bool gzip_;
  std::vector<std::byte> plain_, packed_;
};

}  // namespace torquescope
