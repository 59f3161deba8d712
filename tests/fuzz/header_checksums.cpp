#include "tests/fuzz/header_checksums.hpp"

#include <bit>
#include <cstring>
#include <string_view>
#include <vector>

namespace torquescope {
namespace {

using Bytes = std::span<std::uint8_t>;

struct Mixed {
  std::uint32_t a, b, c;

  void mix() {
    a -= c, a ^= std::rotl(c, 4), c += b;
    b -= a, b ^= std::rotl(a, 6), a += c;
    c -= b, c ^= std::rotl(b, 8), b += a;
    a -= c, a ^= std::rotl(c, 16), c += b;
    b -= a, b ^= std::rotl(a, 19), a += c;
    c -= b, c ^= std::rotl(b, 4), b += a;
  }
  void finish() {
    c ^= b, c -= std::rotl(b, 14);
    a ^= c, a -= std::rotl(c, 11);
    b ^= a, b -= std::rotl(a, 25);
    c ^= b, c -= std::rotl(b, 16);
    a ^= c, a -= std::rotl(c, 4);
    b ^= a, b -= std::rotl(a, 14);
    c ^= b, c -= std::rotl(b, 24);
  }
};

std::uint32_t lookup3(std::span<std::uint8_t const> bytes) {
  std::uint32_t const begin = 0xdeadbeefU + static_cast<std::uint32_t>(bytes.size());
  Mixed state{begin, begin, begin};
  while (!bytes.empty()) {
    std::uint32_t words[3] = {0, 0, 0};
    std::size_t const count = std::min<std::size_t>(bytes.size(), sizeof(words));
    std::memcpy(words, bytes.data(), count);
    bytes = bytes.subspan(count);
    state.a += words[0], state.b += words[1], state.c += words[2];
    bytes.empty() ? state.finish() : state.mix();
  }
  return state.c;
}

std::uint64_t number_at(Bytes file, std::size_t place, std::size_t size) {
  std::uint64_t number = 0;
  std::memcpy(&number, file.data() + place, size);
  return number;
}

// of the bytes [begin, end - 4), at their end
void renew(Bytes file, std::size_t begin, std::size_t end) {
  std::uint32_t const sum = lookup3(file.subspan(begin, end - begin - 4));
  std::memcpy(file.data() + end - 4, &sum, 4);
}

bool holds(Bytes file, std::size_t place, std::string_view signature) {
  return place <= file.size() && file.size() - place >= signature.size() &&
         std::memcmp(file.data() + place, signature.data(), signature.size()) == 0;
}

struct Block {
  std::size_t begin, messages, end;
};

// where the messages of a header name its further blocks
void add_continuations(Bytes file, Block const& block, bool ordered, std::vector<Block>& blocks) {
  constexpr std::uint64_t continuation = 0x10;
  std::size_t const head = ordered ? 6 : 4;
  for (std::size_t at = block.messages; at + head <= block.end - 4;) {
    std::uint64_t const kind = number_at(file, at, 1), size = number_at(file, at + 1, 2);
    at += head;
    if (size > block.end - 4 - at) return;
    if (kind == continuation && size >= 16) {
      std::uint64_t const place = number_at(file, at, 8), length = number_at(file, at + 8, 8);
      if (holds(file, place, "OCHK") && length >= 8 && length <= file.size() - place)
        blocks.push_back({place, place + 4, place + length});
    }
    at += size;
  }
}

void renew_object_header(Bytes file, std::size_t begin) {
  constexpr std::size_t most_blocks = 64;
  if (file.size() - begin < 32 || file[begin + 4] != 2) return;
  unsigned const flags = file[begin + 5];
  std::size_t const width = std::size_t{1} << (flags & 3);
  std::size_t const sized = begin + 6 + (flags & 0x20 ? 16 : 0) + (flags & 0x10 ? 4 : 0);
  if (sized + width > file.size()) return;
  std::uint64_t const size = number_at(file, sized, width);
  if (size > file.size() || sized + width + size + 4 > file.size()) return;
  std::vector<Block> blocks{{begin, sized + width, sized + width + size + 4}};
  for (std::size_t k = 0; k < blocks.size() && k < most_blocks; ++k) {
    Block const block = blocks[k];
    add_continuations(file, block, (flags & 4) != 0, blocks);
    renew(file, block.begin, block.end);
  }
}

}  // namespace

void renew_header_checksums(Bytes file) {
  constexpr std::size_t superblock_size = 48;
  if (holds(file, 0, "\x89HDF\r\n\x1a\n") && file.size() >= superblock_size && file[8] >= 2)
    renew(file, 0, superblock_size);
  for (std::size_t at = 0; at + 32 < file.size(); ++at)
    if (holds(file, at, "OHDR")) renew_object_header(file, at);
}

}  // namespace torquescope
