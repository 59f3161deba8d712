#include "tests/fuzz/seal.hpp"

#include <algorithm>
#include <cstring>

#include "engine/base/digest.hpp"

namespace torquescope {
namespace {

constexpr std::size_t footer_bytes = 96, range_bytes = 16, counts_at = 16, digest_at = 64;

std::uint64_t number_at(std::span<std::uint8_t const> file, std::size_t place) {
  std::uint64_t number = 0;
  std::memcpy(&number, file.data() + place, sizeof(number));
  return number;
}

}  // namespace

void renew_seal(std::span<std::uint8_t> file) {
  if (file.size() < footer_bytes) return;
  std::size_t const footer = file.size() - footer_bytes;
  if (std::memcmp(file.data() + footer, "TORQUESCOPESEAL1", counts_at) != 0) return;
  std::uint64_t const ranges = number_at(file, footer + counts_at + 8);
  if (ranges > footer / range_bytes) return;
  std::size_t const table = footer - ranges * range_bytes;
  if (number_at(file, footer + counts_at) != table) return;
  Digest digest;
  digest.bytes(file.data() + footer, digest_at).bytes(file.data() + table, footer - table);
  std::size_t place = 0;
  for (std::size_t i = 0; i <= ranges; ++i) {
    std::size_t const begin = i < ranges ? number_at(file, table + i * range_bytes) : table;
    std::size_t const end = i < ranges ? number_at(file, table + i * range_bytes + 8) : table;
    if (begin < place || end < begin || end > table) return;
    digest.bytes(file.data() + place, begin - place);
    place = end;
  }
  Sha256 const sha256 = digest.raw();
  std::copy(sha256.begin(), sha256.end(), file.begin() + static_cast<std::ptrdiff_t>(footer + digest_at));
}

}  // namespace torquescope
