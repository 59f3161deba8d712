#pragma once
// Rows of one dataset for somebody who asks for few at a time, mostly forwards: many are read at once and kept.
//
// Why        HDF5 reads, checks and copies a whole chunk, up to 1 MiB, for a single row of it
// Memory     as many bytes as it is given, twice where chunks are that large, and what is asked for at once; the same
//            again and again, unless somebody owns the rows
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
      : path_(std::move(path)),
        all_(info.rows()),
        width_(info.values_per_row()),
        chunk_(info.chunk.empty() ? 1 : info.chunk.front()) {
    std::size_t const value = info.element == h5::Element::text ? info.text_size : sizeof(double);
    std::size_t const rows = bytes / std::max<std::size_t>(1, info.values_per_row() * value);
    at_once_ = 2 * rows < chunk_ ? rows : (rows + chunk_ / 2) / chunk_ * chunk_;
  }

  // rows [first, first + count), row-major; valid until the next call. `open` gives the reader, if rows must be read
  template <class Open>
  std::span<Value const> rows(Open&& open, std::size_t first, std::size_t count) {
    if (count == 0) return {};
    if (first < first_ || first + count > end()) read(open(), first, count);
    return {values_.get() + (first - first_) * width_, count * width_};
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
    std::size_t const until = std::max(first + count, end_ahead(from));
    // before memory is taken the reader says what is wrong
    if (until > all_) return read_rows(reader, from, until - from, {});
    std::size_t const known = from - first;
    make_room(first, known, until - first);
    read_rows(reader, from, until - from, {values_.get() + known * width_, (until - from) * width_});
    n_rows_ = until - first;
  }

  // the rows from `first` on that are there come to the front of room for so many
  void make_room(std::size_t first, std::size_t known, std::size_t rows) {
    bool const has_room = values_.use_count() == 1 && rows * width_ <= room_;
    auto const before = values_;
    if (!has_room) {
      room_ = rows * width_;
      values_ = std::make_shared_for_overwrite<Value[]>(room_ + 1);  // one behind them: spare
    }
    // what somebody else owns stays as it is
    Value const* const from = known > 0 ? before.get() + (first - first_) * width_ : values_.get();
    if (from != values_.get()) std::copy(from, from + known * width_, values_.get());
    first_ = first;
    n_rows_ = known;
  }

  void read_rows(ResultReader const& reader, std::size_t first, std::size_t count, std::span<Value> to) const {
    if constexpr (std::is_same_v<Value, std::string>) {
      auto texts = reader.text_rows(path_, first, count);
      if (texts.size() == to.size()) std::move(texts.begin(), texts.end(), to.begin());
    } else {
      static_assert(sizeof(Value) == h5::spare_for_checksum);
      reader.read_rows(path_, first, count, to, to.empty() ? 0 : sizeof(Value));
    }
  }

  std::string path_;
  std::size_t all_;                     // rows
  std::size_t width_;                   // of one of them
  std::size_t chunk_, at_once_ = 0;     // rows; at once: whole chunks, unless they are much larger
  std::size_t first_ = 0, n_rows_ = 0;  // of the rows that are there
  std::size_t room_ = 0;                // for so many values
  std::shared_ptr<Value[]> values_{};
};

}  // namespace torquescope
