#include "engine/data/npy_array.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/delimited_text.hpp"

namespace torquescope {
namespace {

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t largest_header = std::size_t{1} << 20, most_fields = 4096, most_dimensions = 32;

// what the header says of one type: its width, its kind, or why it is not read
NpyField type_of(std::string const& word) {
  NpyField field;
  bool const has_order = !word.empty() && std::string_view("<>|=").find(word.front()) != std::string_view::npos;
  std::string_view rest = std::string_view(word).substr(has_order ? 1 : 0);
  field.big_endian = has_order && word.front() == '>';
  field.kind = rest.empty() ? '?' : rest.front();
  rest.remove_prefix(rest.empty() ? 0 : 1);
  auto const [end, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), field.bytes);
  if (failure != std::errc{} || field.bytes > (std::size_t{1} << 20)) field.bytes = 0;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  std::size_t const n = field.bytes;
  bool const whole = n == 1 || n == 2 || n == 4 || n == 8;
  switch (field.kind) {
    case 'b':
      if (n != 1) field.objection = "is of a type that is not read here";
      break;
    case 'i':
    case 'u':
      if (!whole) field.objection = "is of a type that is not read here";
      break;
    case 'f':
      if (n != 2 && n != 4 && n != 8)
        field.objection = fmt::format("holds floating-point numbers of {} bytes; save it as float64", n);
      break;
    case 'M':
    case 'm': {
      if (n != 8) field.objection = "is of a type that is not read here";
      auto const unit = [&](std::string_view name, double seconds) {
        if (rest == name) field.seconds_per_unit = seconds;
        return rest == name;
      };
      bool const known = unit("[ns]", 1e-9) || unit("[us]", 1e-6) || unit("[ms]", 1e-3) || unit("[s]", 1.0);
      if (!known) field.objection = "holds dates that are not in ns, us, ms or s";
      break;
    }
    case 'c':
      field.objection = "is complex";
      break;
    case 'O':
      field.objection = "holds Python objects (a pickle); save it as float64";
      break;
    case 'U':
      field.bytes *= 4;
      [[fallthrough]];
    case 'S':
      field.objection = "is text";
      break;
    default:
      field.objection = "is of a type that is not read here";
  }
  return field;
}

// the literal of Python in a header: {'descr': ..., 'fortran_order': False, 'shape': (3, 2), }
class HeaderReader {
 public:
  explicit HeaderReader(std::string_view text) : rest_(text) {}

  // false: it is damaged
  bool read(NpyArray& array) {
    bool has_type = false, has_shape = false;
    if (!take('{')) return false;
    while (!take('}')) {
      auto const key = text();
      if (!key || !take(':')) return false;
      if (*key == "descr") {
        has_type = read_type(array);
        if (!has_type) return false;
      } else if (*key == "shape") {
        auto const sizes = shape();
        if (!sizes) return false;
        array.shape = *sizes;
        has_shape = true;
      } else if (*key == "fortran_order") {
        array.column_major = take_word("True");
        if (!array.column_major && !take_word("False")) return false;
      } else {
        return false;
      }
      take(',');
    }
    return has_type && has_shape;
  }

 private:
  void skip_blanks() {
    auto const first = rest_.find_first_not_of(" \n\t");
    rest_.remove_prefix(first == std::string_view::npos ? rest_.size() : first);
  }
  bool take(char letter) {
    skip_blanks();
    bool const found = !rest_.empty() && rest_.front() == letter;
    if (found) rest_.remove_prefix(1);
    return found;
  }
  bool take_word(std::string_view word) {
    skip_blanks();
    bool const found = rest_.starts_with(word);
    if (found) rest_.remove_prefix(word.size());
    return found;
  }
  std::optional<std::string> text() {
    skip_blanks();
    if (rest_.empty() || (rest_.front() != '\'' && rest_.front() != '"')) return std::nullopt;
    auto const end = rest_.find(rest_.front(), 1);
    if (end == std::string_view::npos) return std::nullopt;
    std::string word(rest_.substr(1, end - 1));
    rest_.remove_prefix(end + 1);
    return word;
  }
  std::optional<std::uint64_t> number() {
    skip_blanks();
    std::uint64_t value = 0;
    auto const [end, failure] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (failure != std::errc{}) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }
  std::optional<std::vector<std::uint64_t>> shape() {
    if (!take('(')) return std::nullopt;
    std::vector<std::uint64_t> sizes;
    while (!take(')')) {
      auto const size = number();
      if (!size || sizes.size() == most_dimensions) return std::nullopt;
      sizes.push_back(*size);
      take(',');
    }
    return sizes;
  }

  // '<f8', or [('t', '<f8'), ('q', '<f4', (7,))]
  bool read_type(NpyArray& array) {
    if (!take('[')) {
      auto const word = text();
      if (!word) return false;
      array.fields = {type_of(*word)};
      array.item_bytes = array.fields.front().bytes;
      return true;
    }
    while (!take(']')) {
      if (!read_field(array) || array.fields.size() > most_fields) return false;
      take(',');
    }
    return !array.fields.empty();
  }

  bool read_field(NpyArray& array) {
    if (!take('(')) return false;
    auto const name = text();
    if (!name || !take(',')) return false;
    auto const word = text();
    if (!word) return false;  // a structure in a structure
    auto field = type_of(*word);
    std::vector<std::uint64_t> sizes;
    if (take(',')) {
      auto const given = shape();
      if (!given) return false;
      sizes = *given;
    }
    if (!take(')')) return false;
    std::uint64_t count = 1;
    for (auto size : sizes) {
      if (size > most_fields || count * size > most_fields) return false;
      count *= size;
    }
    for (std::uint64_t k = 0; k < count; ++k) {
      field.name = count == 1 && sizes.empty() ? *name : fmt::format("{}[{}]", *name, k);
      field.at = array.item_bytes;
      array.item_bytes += field.bytes;
      // padding between the fields is a field without a name
      if (!name->empty()) array.fields.push_back(field);
    }
    return true;
  }

  std::string_view rest_;
};

std::uint64_t bits_at(std::string_view data, std::size_t at, std::size_t size, bool big_endian) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i)
    bits = bits << 8 | static_cast<unsigned char>(data[big_endian ? at + i : at + size - 1 - i]);
  return bits;
}

double from_half(std::uint64_t bits) {
  int const exponent = static_cast<int>(bits >> 10 & 31U);
  auto const fraction = static_cast<double>(bits & 1023U);
  double const size = exponent == 0    ? std::ldexp(fraction, -24)
                      : exponent == 31 ? (fraction == 0.0 ? std::numeric_limits<double>::infinity()
                                                          : std::numeric_limits<double>::quiet_NaN())
                                       : std::ldexp(1024.0 + fraction, exponent - 25);
  return (bits >> 15 & 1U) != 0 ? -size : size;
}

double from_float(std::uint64_t bits, std::size_t size) {
  if (size == 2) return from_half(bits);
  return size == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                   : std::bit_cast<double>(bits);
}

std::int64_t signed_number(std::uint64_t bits, std::size_t size) {
  int const unused = static_cast<int>(64 - 8 * size);
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

}  // namespace

bool is_npy(std::string_view bytes) { return bytes.starts_with(magic); }

std::uint64_t NpyArray::count() const {
  std::uint64_t product = 1;
  for (auto size : shape) product *= size;
  return product;
}

NpyArray read_npy(std::string_view bytes, std::string const& what, std::string const& path) {
  auto const require = [&](bool condition, char const* why) {
    validate(condition,
             [&] { return bad_data(fmt::format("{} {}", what, why), path, 0, "copy it again, or save it again"); });
  };
  require(is_npy(bytes) && bytes.size() >= 12, "is no array of numpy, or was cut short");
  int const version = static_cast<unsigned char>(bytes[6]);
  require(version >= 1 && version <= 3, "is of a version of numpy's format that is not known here");
  std::size_t const count_bytes = version == 1 ? 2 : 4, head = magic.size() + 2 + count_bytes;
  auto const length = static_cast<std::size_t>(bits_at(bytes, magic.size() + 2, count_bytes, false));
  require(length <= largest_header && length <= bytes.size() - head, "has a damaged header");
  NpyArray array;
  require(HeaderReader(bytes.substr(head, length)).read(array), "has a header that is damaged or not known here");
  array.data = bytes.substr(head + length);

  // divided, because a hostile size would overflow the product
  std::uint64_t room = array.item_bytes == 0 ? 0 : array.data.size() / array.item_bytes;
  bool const is_empty = std::find(array.shape.begin(), array.shape.end(), 0U) != array.shape.end();
  bool const readable =
      std::none_of(array.fields.begin(), array.fields.end(), [](auto const& f) { return f.kind == 'O'; });
  for (auto size : array.shape) {
    if (is_empty || !readable || array.item_bytes == 0) break;
    require(size <= room, "claims more numbers than its bytes hold: it was cut short");
    room /= size;
  }
  if (is_empty) array.shape = {0};
  return array;
}

double npy_value(NpyArray const& array, NpyField const& field, std::uint64_t index) {
  std::uint64_t const bits =
      bits_at(array.data, static_cast<std::size_t>(index) * array.item_bytes + field.at, field.bytes, field.big_endian);
  switch (field.kind) {
    case 'f':
      return from_float(bits, field.bytes);
    case 'i':
      return static_cast<double>(signed_number(bits, field.bytes));
    case 'M':
    case 'm': {
      std::int64_t const units = signed_number(bits, field.bytes);
      bool const missing = units == std::numeric_limits<std::int64_t>::min();  // NaT
      return missing ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(units) * field.seconds_per_unit;
    }
    case 'b':
      return bits != 0 ? 1.0 : 0.0;
    default:
      return static_cast<double>(bits);
  }
}

}  // namespace torquescope
