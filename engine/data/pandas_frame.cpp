#include "engine/data/pandas_frame.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "engine/data/hdf5_access.hpp"
#include "engine/data/text_encoding.hpp"

namespace torquescope {
namespace {

// UTF-8 of a code point; "" of one that is none
std::string utf8_of(std::uint32_t point) {
  constexpr std::uint32_t first_surrogate = 0xd800, last_surrogate = 0xdfff, last = 0x10ffff;
  if (point > last || (point >= first_surrogate && point <= last_surrogate)) return {};
  auto const byte = [](std::uint32_t bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
  auto const tail = [&](int shift) { return byte(0x80U | ((point >> shift) & 0x3fU)); };
  if (point < 0x80) return {byte(point)};
  if (point < 0x800) return {byte(0xc0U | (point >> 6)), tail(0)};
  if (point < 0x10000) return {byte(0xe0U | (point >> 12)), tail(6), tail(0)};
  return {byte(0xf0U | (point >> 18)), tail(12), tail(6), tail(0)};
}

// raw-unicode-escape of Python: ISO 8859-1 with \uXXXX and \UXXXXXXXX; nothing: damaged
std::optional<std::string> unescaped(std::string_view letters) {
  std::string text;
  for (std::size_t at = 0; at < letters.size(); ++at) {
    bool const escape =
        letters[at] == '\\' && at + 1 < letters.size() && (letters[at + 1] == 'u' || letters[at + 1] == 'U');
    if (!escape) {
      text += utf8_of(static_cast<unsigned char>(letters[at]));
      continue;
    }
    std::size_t const digits = letters[at + 1] == 'u' ? 4 : 8;
    auto const number = letters.substr(at + 2, digits);
    std::uint32_t point = 0;
    auto const [end, failure] = std::from_chars(number.data(), number.data() + number.size(), point, 16);
    if (number.size() != digits || failure != std::errc{} || end != number.data() + digits) return std::nullopt;
    text += utf8_of(point);
    at += 1 + digits;
  }
  return text;
}

class PickleText {
 public:
  explicit PickleText(std::string_view text) : rest_(text) {}

  std::vector<std::string> names() {
    if (!take("(l")) return {};
    std::vector<std::string> names;
    for (skip_memo(); !take("."); skip_memo()) {
      bool const is_text = take("V");
      auto const value = is_text || take("I") ? line() : std::nullopt;
      auto name = value && is_text ? unescaped(*value) : value;
      skip_memo();
      if (!name || !take("a")) return {};
      names.push_back(std::move(*name));
    }
    return names;
  }

 private:
  bool take(std::string_view word) {
    bool const found = rest_.starts_with(word);
    if (found) rest_.remove_prefix(word.size());
    return found;
  }
  std::optional<std::string> line() {
    auto const end = rest_.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    std::string text(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return text;
  }
  void skip_memo() {
    if (take("p")) line();
  }

  std::string_view rest_;
};

}  // namespace

bool is_fixed_frame(hid_t group) {
  auto const type = text_attribute(group, "pandas_type");
  return !type.empty() && type[0] == "frame";
}

bool holds_pandas_names(std::string const& dataset) { return dataset == "axis0" || dataset.ends_with("_items"); }

std::vector<std::string> fixed_frame_names(hid_t group, std::string const& dataset, std::string const& prefix) {
  constexpr std::string_view values = "_values";
  if (dataset == "axis1") {
    constexpr char const* no_name = "N.";  // None as a pickle
    Handle const index(H5Oopen(group, dataset.c_str(), H5P_DEFAULT), H5Oclose);
    auto const given = index ? text_attribute(index.id(), "name") : std::vector<std::string>{};
    return {prefix + (given.empty() || given[0].empty() || given[0] == no_name ? "index" : given[0])};
  }
  if (!dataset.ends_with(values)) return {};
  auto names = text_dataset(group, dataset.substr(0, dataset.size() - values.size()) + "_items");
  for (auto& column : names) column = prefix + column;
  return names;
}

std::vector<std::string> table_field_names(hid_t dataset, std::string const& field) {
  auto const pickle = text_attribute(dataset, (field + "_kind").c_str());
  return pickle.size() == 1 ? names_in_pickle(pickle[0]) : std::vector<std::string>{};
}

std::vector<std::string> names_in_pickle(std::string_view pickle) { return PickleText(pickle).names(); }

}  // namespace torquescope
