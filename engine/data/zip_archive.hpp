#pragma once
// The members of a zip file: stored ones and deflated ones.
//
// Bounds     members as many as the archive's directory has bytes for; a member may unpack to what it claims, never to
//            more than 1032 times its packed bytes (the best deflate can do)
// Refused    zip64, encryption, other ways of packing, several volumes
// Errors     Error 65, naming the file
// Threads    const after construction
// Source     PKWARE APPNOTE.TXT 6.3.3, sections 4.3 and 4.4; RFC 1951 (deflate)

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace torquescope {

struct ZipMember {
  std::string name;
  std::uint32_t checksum = 0;  // CRC-32 of the unpacked bytes
  std::uint64_t packed_bytes = 0, bytes = 0;
  std::uint64_t header_at = 0;
  int method = 0;  // 0 stored, 8 deflated
};

bool is_zip(std::string_view bytes);

class ZipArchive {
 public:
  // `bytes` must outlive the archive; `path` only for messages
  ZipArchive(std::string_view bytes, std::string path);
  std::vector<ZipMember> const& members() const { return members_; }
  std::string unpack(ZipMember const& member) const;

 private:
  void read_directory(std::size_t at, std::size_t count);
  [[noreturn]] void damaged(std::string const& why) const;
  std::string inflate_raw(std::string_view packed, ZipMember const& member) const;

  std::string_view bytes_;
  std::string path_;
  std::vector<ZipMember> members_;
};

}  // namespace torquescope
