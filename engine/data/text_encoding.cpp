#include "engine/data/text_encoding.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"

namespace torquescope {
namespace {

constexpr std::string_view little_mark = "\xff\xfe", big_mark = "\xfe\xff", utf8_mark = "\xef\xbb\xbf";

bool is_little_utf16(std::string_view bytes) {
  bool const unmarked =
      bytes.size() > 3 && bytes[0] != '\0' && bytes[1] == '\0' && bytes[2] != '\0' && bytes[3] == '\0';
  return bytes.starts_with(little_mark) || unmarked;
}

bool is_big_utf16(std::string_view bytes) {
  bool const unmarked =
      bytes.size() > 3 && bytes[0] == '\0' && bytes[1] != '\0' && bytes[2] == '\0' && bytes[3] != '\0';
  return bytes.starts_with(big_mark) || unmarked;
}

void append_utf8(std::string& text, std::uint32_t code) {
  auto const byte = [&](std::uint32_t value) { text.push_back(static_cast<char>(value)); };
  auto const six_bits = [&](int shift) { byte(0x80U | (code >> shift & 0x3fU)); };
  if (code < 0x80) return byte(code);
  if (code < 0x800) {
    byte(0xc0U | code >> 6);
  } else if (code < 0x10000) {
    byte(0xe0U | code >> 12);
    six_bits(6);
  } else {
    byte(0xf0U | code >> 18);
    six_bits(12);
    six_bits(6);
  }
  six_bits(0);
}

Problem damaged_utf16(std::string const& path) {
  return bad_data(fmt::format("{} is damaged UTF-16 text", path), path, 0,
                  "copy it again, or save it as UTF-8 (iconv -f UTF-16 -t UTF-8)");
}

std::string from_utf16(std::string_view bytes, bool big, std::string const& path) {
  if (bytes.starts_with(big ? big_mark : little_mark)) bytes.remove_prefix(2);
  validate(bytes.size() % 2 == 0, [&] { return damaged_utf16(path); });
  auto const unit = [&](std::size_t i) {
    auto const first = static_cast<unsigned char>(bytes[i]), second = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<std::uint32_t>(big ? first << 8 | second : second << 8 | first);
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    bool const surrogate = code >= 0xd800 && code < 0xe000;
    if (surrogate) {
      bool const paired = code < 0xdc00 && i + 3 < bytes.size() && unit(i + 2) >= 0xdc00 && unit(i + 2) < 0xe000;
      validate(paired, [&] { return damaged_utf16(path); });
      i += 2;
      code = 0x10000 + ((code - 0xd800) << 10) + (unit(i) - 0xdc00);
    }
    append_utf8(text, code);
  }
  return text;
}

// how many bytes the UTF-8 letter at the front takes; 0: it is none
std::size_t utf8_length(std::string_view text) {
  auto const lead = static_cast<unsigned char>(text.front());
  std::size_t const length = lead < 0x80                   ? 1
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 0;
  return length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    std::size_t const length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

bool looks_like_utf16(std::string_view first_bytes) {
  return is_little_utf16(first_bytes) || is_big_utf16(first_bytes);
}

std::string utf8_or_latin1(std::string_view letters) {
  if (is_utf8(letters)) return std::string(letters);
  std::string text;
  for (char letter : letters) append_utf8(text, static_cast<unsigned char>(letter));
  return text;
}

std::string utf8_text(std::string bytes, std::string const& path, std::vector<std::string>& remarks) {
  if (looks_like_utf16(bytes)) {
    remarks.emplace_back("The text is UTF-16 and was read as such.");
    bytes = from_utf16(bytes, is_big_utf16(bytes), path);
  }
  if (bytes.starts_with(utf8_mark)) bytes.erase(0, utf8_mark.size());
  std::size_t const end = bytes.find_last_not_of('\0') + 1;
  if (end > 0 && end < bytes.size()) {
    remarks.push_back(
        fmt::format("The file ends in {} zero bytes, as after a power cut: they are left out.", bytes.size() - end));
    bytes.resize(end);
  }
  validate(bytes.find('\0') == std::string::npos, [&] {
    return bad_data(fmt::format("{} is not text throughout: it holds zero bytes", path), path, 0,
                    "copy it again, or export it again as CSV");
  });
  return bytes;
}

}  // namespace torquescope
