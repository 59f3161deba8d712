#pragma once
// A row-major block of numbers that somebody else owns: one row per member, one column per parameter.
//
// Shapes     data[row * columns + column]
// Requires   the owner outlives the view
// Threads    as its elements

#include <cstddef>
#include <span>

#include "engine/base/contract.hpp"

namespace torquescope {

template <class Number>
class MatrixView {
 public:
  MatrixView() = default;
  MatrixView(Number* data, std::size_t rows, std::size_t columns) : data_(data), rows_(rows), columns_(columns) {}
  // a view of mutable numbers is also a view of constant ones
  operator MatrixView<Number const>() const { return {data_, rows_, columns_}; }

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  Number* data() const { return data_; }

  Number& operator()(std::size_t row, std::size_t column) const {
    TORQUESCOPE_EXPECT(row < rows_ && column < columns_);
    return data_[row * columns_ + column];
  }
  std::span<Number> row(std::size_t row) const {
    TORQUESCOPE_EXPECT(row < rows_);
    return {data_ + row * columns_, columns_};
  }
  MatrixView rows(std::size_t first, std::size_t count) const {
    TORQUESCOPE_EXPECT(first + count <= rows_);
    return {data_ + first * columns_, count, columns_};
  }

 private:
  Number* data_ = nullptr;
  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
};

}  // namespace torquescope
