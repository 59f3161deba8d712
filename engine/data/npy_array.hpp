#pragma once
// An array as numpy.save writes it: a header in words, then the numbers.
//
// Types      b1, i1 i2 i4 i8, u1 u2 u4 u8, f2 f4 f8, M8 and m8 (dates and spans of time, in seconds) of either byte
//            order, and structured types whose fields are these; anything else is an array that cannot be used
// Shapes     values are row-major, whatever order the file keeps
// Errors     Error 65 when the header is damaged or claims more numbers than the bytes hold
// Threads    functions of their arguments
// Source     numpy.lib.format, versions 1.0 to 3.0

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace torquescope {

struct NpyField {
  std::string name;  // empty: the array has no fields
  std::size_t at = 0, bytes = 0;
  char kind = 'f';          // b i u f M m; others hold no numbers
  std::string objection{};  // why it holds no numbers
  bool big_endian = false;
  double seconds_per_unit = 1.0;  // of M and m
};

struct NpyArray {
  std::vector<std::uint64_t> shape;
  bool column_major = false;
  std::size_t item_bytes = 0;
  std::vector<NpyField> fields;
  std::string_view data;

  std::uint64_t count() const;
};

bool is_npy(std::string_view bytes);
// `what` and `path` only for messages: "a.npz (q.npy)"; the array points into `bytes`
NpyArray read_npy(std::string_view bytes, std::string const& what, std::string const& path);
// item `index` of the data as it lies there
double npy_value(NpyArray const& array, NpyField const& field, std::uint64_t index);

}  // namespace torquescope
