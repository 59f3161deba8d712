#include "engine/data/zip_archive.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/delimited_text.hpp"
#include "engine/data/packed_size.hpp"

namespace torquescope {
namespace {

constexpr std::string_view local_header = "PK\x03\x04", directory_entry = "PK\x01\x02", directory_end("PK\x05\x06", 4);
constexpr std::size_t local_size = 30, entry_size = 46, end_size = 22;
constexpr int stored = 0, deflated = 8;

std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

class RawInflater {
 public:
  RawInflater() {
    constexpr int no_header = -MAX_WBITS;
    if (inflateInit2(&stream_, no_header) != Z_OK) throw std::bad_alloc();
  }
  ~RawInflater() { inflateEnd(&stream_); }
  RawInflater(RawInflater const&) = delete;
  RawInflater& operator=(RawInflater const&) = delete;
  z_stream& stream() { return stream_; }

 private:
  z_stream stream_{};
};

std::uint32_t crc32_of(std::string_view bytes) {
  uLong sum = crc32(0L, nullptr, 0);
  while (!bytes.empty()) {
    auto const piece = bytes.substr(0, std::numeric_limits<uInt>::max());
    sum = crc32(sum, reinterpret_cast<Bytef const*>(piece.data()), static_cast<uInt>(piece.size()));
    bytes.remove_prefix(piece.size());
  }
  return static_cast<std::uint32_t>(sum);
}

}  // namespace

bool is_zip(std::string_view bytes) { return bytes.starts_with(local_header) || bytes.starts_with(directory_end); }

void ZipArchive::damaged(std::string const& why) const {
  throw Error(bad_data(fmt::format("{} {}", path_, why), path_, 0, "copy it again, or save it again"));
}

ZipArchive::ZipArchive(std::string_view bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {
  // behind the directory stands nothing but a comment
  constexpr std::size_t longest_comment = 65535;
  std::size_t const from = bytes.size() - std::min(bytes.size(), end_size + longest_comment);
  std::size_t const end = bytes.substr(from).rfind(directory_end);
  if (end == std::string_view::npos || bytes.size() - from - end < end_size)
    damaged("is a zip file without its directory: it was cut short");
  std::size_t const at = from + end;
  std::uint64_t const count = number_at(bytes, at + 10, 2), begin = number_at(bytes, at + 16, 4);
  if (number_at(bytes, at + 4, 2) != 0 || number_at(bytes, at + 8, 2) != count)
    damaged("is a zip file of several volumes, which are not read here");
  if (count == 0xffff || begin == 0xffffffff)
    damaged("is a zip64 file, which is not read here: save fewer or smaller arrays in one file");
  read_directory(begin, count);
}

void ZipArchive::read_directory(std::size_t at, std::size_t count) {
  for (; count > 0; --count) {
    bool const fits = at <= bytes_.size() && bytes_.size() - at >= entry_size;
    if (!fits || !bytes_.substr(at).starts_with(directory_entry)) damaged("is a damaged zip file");
    std::size_t const name_size = number_at(bytes_, at + 28, 2);
    std::size_t const whole = entry_size + name_size + number_at(bytes_, at + 30, 2) + number_at(bytes_, at + 32, 2);
    if (whole > bytes_.size() - at) damaged("is a damaged zip file");
    constexpr std::uint64_t encrypted = 1, in_zip64 = 0xffffffff;
    if ((number_at(bytes_, at + 8, 2) & encrypted) != 0) damaged("is an encrypted zip file");
    ZipMember member;
    member.name = std::string(bytes_.substr(at + entry_size, name_size));
    member.method = static_cast<int>(number_at(bytes_, at + 10, 2));
    member.checksum = static_cast<std::uint32_t>(number_at(bytes_, at + 16, 4));
    member.packed_bytes = number_at(bytes_, at + 20, 4);
    member.bytes = number_at(bytes_, at + 24, 4);
    member.header_at = number_at(bytes_, at + 42, 4);
    if (member.packed_bytes == in_zip64 || member.bytes == in_zip64 || member.header_at == in_zip64)
      damaged("is a zip64 file, which is not read here: save fewer or smaller arrays in one file");
    members_.push_back(std::move(member));
    at += whole;
  }
}

std::string ZipArchive::unpack(ZipMember const& member) const {
  std::string const name = shown(member.name);
  std::size_t const at = member.header_at;
  bool const has_header = at <= bytes_.size() && bytes_.size() - at >= local_size;
  if (!has_header || !bytes_.substr(at).starts_with(local_header)) damaged(fmt::format("is damaged at \"{}\"", name));
  std::size_t const begin = at + local_size + number_at(bytes_, at + 26, 2) + number_at(bytes_, at + 28, 2);
  if (begin > bytes_.size() || bytes_.size() - begin < member.packed_bytes)
    damaged(fmt::format("ends in the middle of \"{}\"", name));
  std::string_view const packed = bytes_.substr(begin, member.packed_bytes);
  if (member.method != stored && member.method != deflated)
    damaged(fmt::format("packs \"{}\" in a way that is not read here (method {})", name, member.method));
  std::string unpacked = member.method == stored ? std::string(packed) : inflate_raw(packed, member);
  if (unpacked.size() != member.bytes || crc32_of(unpacked) != member.checksum)
    damaged(fmt::format("is damaged in \"{}\"", name));
  return unpacked;
}

std::string ZipArchive::inflate_raw(std::string_view packed, ZipMember const& member) const {
  constexpr std::size_t block = std::size_t{1} << 20;
  constexpr std::uint64_t best_compression = 1032;
  if (member.bytes > best_compression * packed.size() + block)
    damaged(fmt::format("claims more in \"{}\" than its bytes can hold", shown(member.name)));
  refuse_bomb(member.bytes, bytes_.size(), path_);
  RawInflater inflater;
  z_stream& stream = inflater.stream();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));  // zlib does not write there
  stream.avail_in = static_cast<uInt>(packed.size());                           // 32 bits in the directory
  std::string unpacked;
  std::string piece(block, '\0');
  for (int state = Z_OK; state != Z_STREAM_END;) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(block);
    state = inflate(&stream, Z_NO_FLUSH);
    std::size_t const fresh = block - stream.avail_out;
    unpacked.append(piece, 0, fresh);
    bool const goes_on = state == Z_STREAM_END || (state == Z_OK && (fresh > 0 || stream.avail_in > 0));
    if (!goes_on || unpacked.size() > member.bytes) damaged(fmt::format("is damaged in \"{}\"", shown(member.name)));
  }
  return unpacked;
}

}  // namespace torquescope
