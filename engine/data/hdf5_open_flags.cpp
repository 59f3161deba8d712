#include "engine/data/hdf5_open_flags.hpp"

#include <bit>
#include <cstdint>
#include <string_view>

namespace torquescope {
namespace {

constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
constexpr std::size_t checksum_size = 4;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;)
    word = word << 8 | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0U);
  return word;
}

// Jenkins' lookup3 (hashlittle), as H5_checksum_lookup3 of the library with an initial value of 0
std::uint32_t lookup3(std::string_view bytes) {
  std::uint32_t const begin = 0xdeadbeefU + static_cast<std::uint32_t>(bytes.size());
  std::uint32_t a = begin, b = begin, c = begin;
  while (!bytes.empty()) {
    a += word_at(bytes, 0), b += word_at(bytes, 4), c += word_at(bytes, 8);
    bool const last = bytes.size() <= 12;
    bytes.remove_prefix(last ? bytes.size() : 12);
    if (last) break;
    a -= c, a ^= std::rotl(c, 4), c += b;
    b -= a, b ^= std::rotl(a, 6), a += c;
    c -= b, c ^= std::rotl(b, 8), b += a;
    a -= c, a ^= std::rotl(c, 16), c += b;
    b -= a, b ^= std::rotl(a, 19), a += c;
    c -= b, c ^= std::rotl(b, 4), b += a;
  }
  c ^= b, c -= std::rotl(b, 14);
  a ^= c, a -= std::rotl(c, 11);
  b ^= a, b -= std::rotl(a, 25);
  c ^= b, c -= std::rotl(b, 16);
  a ^= c, a -= std::rotl(c, 4);
  b ^= a, b -= std::rotl(a, 14);
  c ^= b, c -= std::rotl(b, 24);
  return c;
}

}  // namespace

bool clear_open_flags(std::string& file) {
  constexpr std::size_t head = 12, flags_at = 11;
  constexpr unsigned marks = 5;  // 1: open for writing; 4: by a single writer with many readers
  for (std::size_t at = 0; at + head < file.size(); at = at == 0 ? 512 : 2 * at) {
    if (!std::string_view(file).substr(at).starts_with(signature)) continue;
    int const version = static_cast<unsigned char>(file[at + 8]);
    auto const address = static_cast<unsigned char>(file[at + 9]);
    std::size_t const size = head + std::size_t{4} * address + checksum_size;
    bool const has_flags = (version == 2 || version == 3) && address <= 16 && file.size() - at >= size;
    auto const flags = static_cast<unsigned char>(file[at + flags_at]);
    if (!has_flags || (flags & marks) == 0) return false;
    std::size_t const sum_at = at + size - checksum_size;
    auto const sum = [&] { return lookup3(std::string_view(file).substr(at, size - checksum_size)); };
    if (sum() != word_at(file, sum_at)) return false;
    file[at + flags_at] = static_cast<char>(flags & ~marks);
    std::uint32_t const renewed = sum();
    for (std::size_t i = 0; i < checksum_size; ++i) file[sum_at + i] = static_cast<char>(renewed >> (8 * i) & 0xffU);
    return true;
  }
  return false;
}

}  // namespace torquescope
