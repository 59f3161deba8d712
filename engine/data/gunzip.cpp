#include "engine/data/gunzip.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>

#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/packed_size.hpp"
#include "engine/data/text_encoding.hpp"

namespace torquescope {
namespace {

class Inflater {
 public:
  Inflater() {
    constexpr int gzip_only = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, gzip_only) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(Inflater const&) = delete;
  Inflater& operator=(Inflater const&) = delete;
  z_stream& stream() { return stream_; }

 private:
  z_stream stream_{};
};

[[noreturn]] void damaged(std::string const& path, std::string const& why, std::string const& help) {
  throw Error(bad_data(fmt::format("{} {}", path, why), path, 0, help));
}

// zeros may follow the last member (tapes pad so)
bool only_padding(std::string_view rest) { return rest.find_first_not_of('\0') == std::string_view::npos; }

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::string gunzip_text(std::string_view bytes, std::string const& path, std::uint64_t most_bytes) {
  constexpr std::size_t block = std::size_t{1} << 20;
  Inflater inflater;
  z_stream& stream = inflater.stream();
  std::string text;
  std::string piece(block, '\0');
  std::size_t taken = 0;
  bool member_open = true;
  while (member_open) {
    // zlib counts in 32 bits
    std::size_t const given = std::min(bytes.size() - taken, std::size_t{std::numeric_limits<uInt>::max()});
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + taken));  // zlib does not write there
    stream.avail_in = static_cast<uInt>(given);
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(block);
    int const state = inflate(&stream, Z_NO_FLUSH);
    taken += given - stream.avail_in;
    std::string_view const fresh(piece.data(), block - stream.avail_out);
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
      damaged(path, "is damaged gzip" + std::string(stream.msg != nullptr ? std::string(" (") + stream.msg + ")" : ""),
              "copy it again");
    if (text.size() + fresh.size() > most_bytes)
      damaged(path, fmt::format("unpacks to more than {} MiB", most_bytes >> 20),
              "cut it into several recordings: recording.train takes a list");
    refuse_bomb(text.size() + fresh.size(), bytes.size(), path);
    bool const wide = looks_like_utf16(text.empty() ? fresh : std::string_view(text));
    if (!wide && fresh.find('\0') != std::string_view::npos)
      damaged(path, "is gzip, but what it holds is not text", "unpack .mat and .h5 files first (gunzip)");
    text.append(fresh);
    if (state == Z_STREAM_END) {
      member_open = !only_padding(bytes.substr(taken));
      if (member_open) inflateReset(&stream);
    } else if (fresh.empty() && taken == bytes.size()) {
      damaged(path, "ends in the middle of its gzip data", "copy it again: it was cut short");
    }
  }
  return text;
}

}  // namespace torquescope
