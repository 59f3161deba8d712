#pragma once
// Plain values as bytes and back, between a process and its child (confined.hpp): both are the same program, so there
// is no version and no byte order. What comes back from a child that read a hostile file is not trusted either.
//
// Errors     PackedReader: std::out_of_range when the bytes end early or claim more than there is
// Threads    values

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace torquescope {

class PackedWriter {
 public:
  PackedWriter& whole(std::int64_t value) { return raw(&value, sizeof(value)); }
  PackedWriter& text(std::string_view text) {
    return whole(static_cast<std::int64_t>(text.size())).raw(text.data(), text.size());
  }
  PackedWriter& texts(std::vector<std::string> const& list) {
    whole(static_cast<std::int64_t>(list.size()));
    for (auto const& item : list) text(item);
    return *this;
  }
  // doubles or int64
  template <class Number>
  PackedWriter& numbers(std::vector<Number> const& list) {
    return whole(static_cast<std::int64_t>(list.size())).raw(list.data(), list.size() * sizeof(Number));
  }
  std::string take() { return std::move(bytes_); }

 private:
  PackedWriter& raw(void const* data, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<char const*>(data), size);
    return *this;
  }
  std::string bytes_{};
};

class PackedReader {
 public:
  explicit PackedReader(std::string_view bytes) : rest_(bytes) {}

  std::int64_t whole() {
    std::int64_t value = 0;
    std::memcpy(&value, take(sizeof(value)).data(), sizeof(value));
    return value;
  }
  // of things that each take at least one byte
  std::size_t count() {
    auto const value = static_cast<std::size_t>(whole());
    if (value > rest_.size()) throw std::out_of_range("packed bytes claim more than there is");
    return value;
  }
  std::string text() { return std::string(take(count())); }
  std::vector<std::string> texts() {
    std::vector<std::string> list;
    for (std::size_t n = count(); n > 0; --n) list.push_back(text());
    return list;
  }
  template <class Number>
  std::vector<Number> numbers() {
    std::size_t const n = count();
    std::string_view const bytes = take(n * sizeof(Number));  // n <= size of the rest: no overflow
    std::vector<Number> list(n);
    if (n > 0) std::memcpy(list.data(), bytes.data(), bytes.size());
    return list;
  }

 private:
  std::string_view take(std::size_t size) {
    if (size > rest_.size()) throw std::out_of_range("packed bytes end early");
    auto const piece = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return piece;
  }
  std::string_view rest_;
};

}  // namespace torquescope
