#pragma once
// Text inside gzip bytes (RFC 1952), several members included.
//
// Errors     Error 65 when the bytes are damaged, end early, grow beyond the limit or beyond 200 times their size (a
//            zip bomb: 64 MiB are let through), or are no text

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/data/file_bytes.hpp"

namespace torquescope {

bool is_gzip(std::string_view bytes);
// `path` only for messages
std::string gunzip_text(std::string_view bytes, std::string const& path, std::uint64_t most_bytes = largest_file_bytes);

}  // namespace torquescope
