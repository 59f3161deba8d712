#include "engine/store/chunk_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>

#include "engine/base/contract.hpp"
#include "engine/store/fletcher32.hpp"

namespace torquescope {
namespace {

using Checksum = std::uint32_t;

std::size_t product(h5::Shape const& shape, std::size_t begin, std::size_t end) {
  auto const at = [&](std::size_t i) { return shape.begin() + static_cast<std::ptrdiff_t>(i); };
  return std::accumulate(at(begin), at(end), std::size_t{1}, std::multiplies<>());
}

// the dimension that chunks divide: those behind it are whole, those before it have extent 1
std::size_t divided_dimension(h5::DatasetInfo const& info) {
  std::size_t dimension = info.shape.size() - 1;
  while (dimension > 0 && info.chunk[dimension] == info.shape[dimension]) --dimension;
  TORQUESCOPE_EXPECT(product(info.chunk, 0, dimension) == 1);
  return dimension;
}

std::size_t value_bytes(h5::DatasetInfo const& info) {
  return info.element == h5::Element::text ? info.text_size : sizeof(double);
}

}  // namespace

std::span<std::byte> ChunkWriter::room(std::size_t chunk_bytes) {
  plain_.resize(std::max(plain_.size(), chunk_bytes + sizeof(Checksum)));
  return std::span(plain_).first(chunk_bytes);
}

std::span<std::byte const> ChunkWriter::encoded(std::span<std::byte const> part, std::size_t chunk_bytes) {
  bool const made_here = part.data() == plain_.data();
  std::span<std::byte> const chunk = room(chunk_bytes);
  if (!made_here) std::copy(part.begin(), part.end(), chunk.begin());
  std::fill(chunk.begin() + static_cast<std::ptrdiff_t>(part.size()), chunk.end(), std::byte{0});
  std::vector<std::byte>& encoded = gzip_ ? packed_ : plain_;
  std::size_t size = chunk_bytes;
  if (gzip_) {
    uLongf packed = compressBound(chunk_bytes);
    packed_.resize(std::max(packed_.size(), packed + sizeof(Checksum)));
    int const result = compress2(reinterpret_cast<Bytef*>(packed_.data()), &packed,
                                 reinterpret_cast<Bytef const*>(chunk.data()), chunk_bytes, Z_BEST_SPEED);
    if (result != Z_OK) throw h5::Failure("zlib has no memory left");
    size = packed;
  }
  // the checksum comes last: it covers the bytes as they lie on the disk
  Checksum const checksum = fletcher32({encoded.data(), size});
  std::memcpy(encoded.data() + size, &checksum, sizeof(checksum));
  return {encoded.data(), size + sizeof(checksum)};
}

void ChunkWriter::write(h5::Handle const& dataset, h5::DatasetInfo const& info, std::size_t first, std::size_t count,
                        void const* values) {
  std::size_t const rank = info.shape.size(), dimension = divided_dimension(info);
  TORQUESCOPE_EXPECT(first % info.chunk[0] == 0);
  // lines along the divided dimension, `step` bytes from one index to the next
  std::size_t const step = product(info.shape, dimension + 1, rank) * value_bytes(info);
  std::size_t const lines_per_row = product(info.shape, std::min<std::size_t>(1, dimension), dimension);
  std::size_t const lines = dimension == 0 ? 1 : count * lines_per_row;
  std::size_t const length = dimension == 0 ? count : info.shape[dimension];
  std::size_t const in_chunk = info.chunk[dimension];

  auto const* part = static_cast<std::byte const*>(values);
  h5::Shape start(rank, 0);
  start[0] = first;
  for (std::size_t line = 0; line < lines; ++line) {
    std::size_t const line_start = dimension == 0 ? first : 0;
    for (std::size_t index = 0; index < length; index += in_chunk) {
      std::size_t const bytes = std::min(in_chunk, length - index) * step;
      start[dimension] = line_start + index;
      h5::write_chunk(dataset, start, encoded({part, bytes}, in_chunk * step));
      part += bytes;
    }
    // the next line: count up the dimensions before the divided one, the last of them first
    start[dimension] = line_start;
    for (std::size_t i = dimension; i-- > 0;) {
      if (++start[i] < info.shape[i]) break;
      if (i > 0) start[i] = 0;
    }
  }
}

}  // namespace torquescope
