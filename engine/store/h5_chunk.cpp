// Chunks as they lie on the disk, checked and copied here instead of in HDF5.

#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "engine/base/contract.hpp"
#include "engine/store/fletcher32.hpp"
#include "engine/store/h5.hpp"

namespace torquescope::h5 {
namespace {

using FileChecksum = std::uint32_t;

// chunks are whole rows, in the bytes of memory and with no filter but their checksum
bool is_plain(Handle const& dataset, Handle const& memory, DatasetInfo const& info) {
  if (info.chunk.empty() || !std::equal(info.chunk.begin() + 1, info.chunk.end(), info.shape.begin() + 1)) return false;
  Handle const list(checked(H5Dget_create_plist(dataset.id()), "read the storage properties"));
  unsigned flags = 0;
  std::size_t n_values = 0;
  bool const is_checked = H5Pget_nfilters(list.id()) == 1 && H5Pget_filter2(list.id(), 0, &flags, &n_values, nullptr, 0,
                                                                            nullptr, nullptr) == H5Z_FILTER_FLETCHER32;
  if (!is_checked) return false;
  Handle const type(checked(H5Dget_type(dataset.id()), "read a type"));
  return H5Tequal(type.id(), memory.id()) > 0;
}

// the chunk that begins with a row, and its checksum behind it; false unless both are there and agree
bool read_chunk(Handle const& dataset, std::vector<hsize_t> const& start, std::size_t chunk_bytes, std::byte* to) {
  hsize_t stored = 0;
  std::uint32_t filters_left_out = 0;
  bool const is_there = H5Dget_chunk_storage_size(dataset.id(), start.data(), &stored) >= 0 &&
                        stored == chunk_bytes + sizeof(FileChecksum) &&
                        H5Dread_chunk(dataset.id(), H5P_DEFAULT, start.data(), &filters_left_out, to) >= 0;
  if (!is_there || filters_left_out != 0) return false;
  FileChecksum said = 0;
  std::memcpy(&said, to + chunk_bytes, sizeof(said));
  return said == fletcher32({to, chunk_bytes});
}

}  // namespace

bool read_plain_chunks(Handle const& dataset, Handle const& memory, DatasetInfo const& info, std::size_t first,
                       std::size_t count, void* values, std::size_t spare_bytes) {
  TORQUESCOPE_EXPECT(first + count <= info.rows());
  if (!is_plain(dataset, memory, info)) return false;
  std::size_t const value_bytes = info.element == Element::text ? info.text_size : sizeof(double);
  std::size_t const row_bytes = info.values_per_row() * value_bytes, rows = info.chunk.front();
  std::size_t const chunk_bytes = rows * row_bytes, end = first + count;
  auto* const to = static_cast<std::byte*>(values);
  std::vector<hsize_t> start(info.shape.size(), 0);
  std::unique_ptr<std::byte[]> apart;  // of a chunk that does not fit where its rows belong
  for (std::size_t row = first; row < end;) {
    std::size_t const begin = row / rows * rows, next = std::min(begin + rows, end);
    start[0] = begin;
    // its checksum lies where the next chunk's rows come
    bool const fits =
        row == begin && begin + rows <= end && (end - begin - rows) * row_bytes + spare_bytes >= sizeof(FileChecksum);
    if (!fits && !apart) apart = std::make_unique_for_overwrite<std::byte[]>(chunk_bytes + sizeof(FileChecksum));
    std::byte* const place = to + (row - first) * row_bytes;
    if (!read_chunk(dataset, start, chunk_bytes, fits ? place : apart.get())) return false;
    if (!fits) std::memcpy(place, apart.get() + (row - begin) * row_bytes, (next - row) * row_bytes);
    row = next;
  }
  return true;
}

}  // namespace torquescope::h5
