#include "engine/store/chunking.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace torquescope {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 20;

std::size_t bytes_of(std::vector<std::size_t> const& chunk, std::size_t bytes_per_value) {
  return std::accumulate(chunk.begin(), chunk.end(), bytes_per_value, std::multiplies<>());
}

std::size_t divided_up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

}  // namespace

std::vector<std::size_t> chunk_of_array(std::vector<std::size_t> shape, std::size_t bytes_per_value) {
  // equal parts rather than full ones: a last part that is nearly empty would still take its whole space
  for (std::size_t& extent : shape) {
    std::size_t const bytes = bytes_of(shape, bytes_per_value);
    if (bytes <= most_bytes) break;
    std::size_t const fitting = std::max<std::size_t>(1, extent * most_bytes / bytes);
    std::size_t const parts = divided_up(extent, fitting);
    extent = divided_up(extent, parts);
  }
  return shape;
}

std::vector<std::size_t> chunk_of_runs(std::vector<std::size_t> shape, std::size_t bytes_per_value) {
  std::size_t const runs = shape[0];
  shape[0] = 1;
  std::size_t const bytes_of_one = bytes_of(shape, bytes_per_value);
  if (bytes_of_one > most_bytes) return chunk_of_array(shape, bytes_per_value);
  shape[0] = std::clamp<std::size_t>(shared_chunk_bytes / bytes_of_one, 1, runs);
  return shape;
}

}  // namespace torquescope
