#pragma once
// The text of a file as UTF-8, whatever an instrument's program wrote it as.
//
// Known      UTF-8 with or without its byte order mark; UTF-16 of either byte order, with a mark or told by the zeros
//            in the first letters; zero bytes at the end (a disk that lost power) are cut off
// Errors     Error 65 for zero bytes elsewhere, and for UTF-16 that is damaged
// Source     RFC 2781 (UTF-16), RFC 3629 (UTF-8)

#include <string>
#include <string_view>
#include <vector>

namespace torquescope {

bool looks_like_utf16(std::string_view first_bytes);
// remarks: what was done; `path` only for messages
std::string utf8_text(std::string bytes, std::string const& path, std::vector<std::string>& remarks);
// letters that are not UTF-8 are taken for ISO 8859-1, as old instruments write their degree signs
std::string utf8_or_latin1(std::string_view letters);

}  // namespace torquescope
