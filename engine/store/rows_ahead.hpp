#pragma once
// Rows of one dataset for somebody who asks for few at a time, mostly forwards: many are read at once and kept.
//
// Why        HDF5 reads, checks and copies a whole chunk, up to 1 MiB, for a single row of it
// Memory     as many bytes as it is given, twice where chunks are that large, and what is asked for at once
// Errors     those of ResultReader
// Threads    as HDF5: one of the process at a time

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/store/result_reader.hpp"

namespace torquescope {

// Value: double, std::int64_t or std::string, as the dataset holds
template <class Value>
class RowsAhead {
 public:
  // bytes: of what is read at once, about
  RowsAhead(std::string path, h5::DatasetInfo const& info, std::size_t bytes)
      : path_(std::move(path)), all_(info.rows()), chunk_(info.chunk.empty() ? 1 : info.chunk.front()) {
    std::size_t const value = info.element == h5::Element::text ? info.text_size : sizeof(double);
    std::size_t const rows = bytes / std::max<std::size_t>(1, info.values_per_row() * value);
    at_once_ = 2 * rows < chunk_ ? rows : (rows + chunk_ / 2) / chunk_ * chunk_;
  }

  // rows [first, first + count), row-major; valid until the next call. `open` gives the reader, if rows must be read
  template <class Open>
  std::span<Value const> rows(Open&& open, std::size_t first, std::size_t count) {
    if (count == 0) return {};
    if (first < first_ || first + count > end()) read(open(), first, count);
    return std::span<Value const>(*values_).subspan((first - first_) * width_, count * width_);
  }
  // of the rows given last: while it lives they stay as they are
  std::shared_ptr<void const> owner() const { return values_; }

 private:
  std::size_t end() const { return first_ + n_rows_; }

  // one row behind the last that is read with row `from`
  std::size_t end_ahead(std::size_t from) const {
    std::size_t const end = std::min(from + at_once_, all_);
    return end < all_ && at_once_ >= chunk_ ? end / chunk_ * chunk_ : end;
  }

  void read(ResultReader const& reader, std::size_t first, std::size_t count) {
    // what is there already is not read again
    std::size_t const from = first >= first_ && first < end() ? end() : first;
    // more than there is stays as it was asked for: the reader says what is wrong
    std::size_t const until = std::max(first + count, end_ahead(from));
    std::vector<Value> fresh = read_rows(reader, from, until - from);
    std::size_t const known = from - first;
    width_ = fresh.size() / (until - from);
    if (known > 0)
      fresh.insert(fresh.begin(), values_->end() - static_cast<std::ptrdiff_t>(known * width_), values_->end());
    values_ = std::make_shared<std::vector<Value> const>(std::move(fresh));
    first_ = first;
    n_rows_ = until - first;
  }

  std::vector<Value> read_rows(ResultReader const& reader, std::size_t first, std::size_t count) const {
    if constexpr (std::is_same_v<Value, double>)
      return reader.number_rows(path_, first, count);
    else if constexpr (std::is_same_v<Value, std::int64_t>)
      return reader.whole_number_rows(path_, first, count);
    else
      return reader.text_rows(path_, first, count);
  }

  std::string path_;
  std::size_t all_, chunk_, at_once_ = 0;           // rows; at once: whole chunks, unless they are much larger
  std::size_t first_ = 0, n_rows_ = 0, width_ = 0;  // of the rows that are there
  std::shared_ptr<std::vector<Value> const> values_{};
};

}  // namespace torquescope
