// The reader of MATLAB level 5 files.

#include <matio.h>

#include "engine/base/digest.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/data/file_bytes.hpp"
#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace mat5_test {

using data_test::problem_of;
using data_test::recording_section;

class MatWriter {
 public:
  explicit MatWriter(std::string const& name, matio_compression compression = MAT_COMPRESSION_NONE)
      : path_(data_test::folder() / name),
        file_(Mat_CreateVer(path_.c_str(), nullptr, MAT_FT_MAT5)),
        compression_(compression) {}
  ~MatWriter() { Mat_Close(file_); }
  MatWriter(MatWriter const&) = delete;
  MatWriter& operator=(MatWriter const&) = delete;

  void matrix(char const* name, std::size_t rows, std::size_t columns, matio_classes kind, matio_types type, void* data,
              int flags = 0) {
    std::size_t sizes[2] = {rows, columns};
    matvar_t* variable = Mat_VarCreate(name, kind, type, 2, sizes, data, flags);
    Mat_VarWrite(file_, variable, compression_);
    Mat_VarFree(variable);
  }
  void doubles(char const* name, std::size_t rows, std::size_t columns, std::vector<double> values) {
    matrix(name, rows, columns, MAT_C_DOUBLE, MAT_T_DOUBLE, values.data());
  }

 private:
  std::filesystem::path path_;
  mat_t* file_;
  matio_compression compression_;
};

void write_arm(std::string const& name, matio_compression compression) {
  MatWriter file(name, compression);
  file.doubles("t", 4, 1, {0, 0.001, 0.002, 0.003});
  file.doubles("row", 1, 4, {4, 5, 6, 7});
  file.doubles("pair", 4, 2, {1, 2, 3, 4, 10, 20, 30, 40});
  std::int16_t counts[] = {1, -2, 3, -4};
  file.matrix("counts", 4, 1, MAT_C_INT16, MAT_T_INT16, counts);
  file.doubles("rate", 1, 1, {1000});
  char remark[] = "arm";
  file.matrix("remark", 1, 3, MAT_C_CHAR, MAT_T_UTF8, remark);
  double real[] = {1, 2, 3, 4}, imaginary[] = {0, 1, 0, 1};
  mat_complex_split_t both{real, imaginary};
  file.matrix("phasor", 4, 1, MAT_C_DOUBLE, MAT_T_DOUBLE, &both, MAT_F_COMPLEX);
}

std::string reason_of(RawTable const& table, std::string const& name) {
  for (auto const& column : table.unusable)
    if (column.name == name) return column.reason;
  return "(usable)";
}

class Mat5Reader : public testing::TestWithParam<matio_compression> {};

TEST_P(Mat5Reader, ReadsVectorsAndTheColumnsOfMatrices) {
  write_arm("arm.dat", GetParam());
  auto const path = data_test::folder() / "arm.dat";
  auto const table = read_table(path, recording_section());
  EXPECT_EQ(table.names, (std::vector<std::string>{"t", "row", "pair[0]", "pair[1]", "counts"}));
  EXPECT_EQ(table.columns[0], (std::vector<double>{0, 0.001, 0.002, 0.003}));
  EXPECT_EQ(table.columns[1], (std::vector<double>{4, 5, 6, 7}));
  EXPECT_EQ(table.columns[3], (std::vector<double>{10, 20, 30, 40}));
  EXPECT_EQ(table.columns[4], (std::vector<double>{1, -2, 3, -4}));
  EXPECT_EQ(table.sha256, sha256_hex(read_whole_file(path)));
  EXPECT_EQ(reason_of(table, "rate"), "has 1 values where the signals have 4");
  EXPECT_EQ(reason_of(table, "remark"), "is text");
  EXPECT_EQ(reason_of(table, "phasor"), "is complex");
}

INSTANTIATE_TEST_SUITE_P(PlainAndPacked, Mat5Reader, testing::Values(MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB));

TEST(Mat5Reader, FileOfTextOnlyIsRefused) {
  {
    MatWriter file("text.mat");
    char remark[] = "arm";
    file.matrix("remark", 1, 3, MAT_C_CHAR, MAT_T_UTF8, remark);
  }
  auto const problem = problem_of([&] { read_table(data_test::folder() / "text.mat", recording_section()); });
  EXPECT_EQ(problem.code, ExitCode::bad_data);
  EXPECT_TRUE(problem.what.ends_with("holds no columns of numbers"));
  EXPECT_EQ(problem.notes, std::vector<std::string>{"\"remark\" is text"});
}

// stumps and flipped bytes either still read or are refused with exit code 65
TEST(Mat5Reader, DamageNeverEscapesAsAnythingButAnError) {
  write_arm("good.mat", MAT_COMPRESSION_ZLIB);
  write_arm("plain.mat", MAT_COMPRESSION_NONE);
  for (auto const* name : {"good.mat", "plain.mat"}) {
    auto const good = read_whole_file(data_test::folder() / name);
    for (std::uint32_t trial = 0; trial < 150; ++trial) {
      RandomStream stream({13, 0, RandomDomain::test}, 0, trial);
      auto bytes = good;
      for (std::uint32_t k = stream.below(6); k-- > 0;)
        bytes[128 + stream.below(static_cast<std::uint32_t>(bytes.size() - 128))] =
            static_cast<char>(stream.below(256));
      if (stream.uniform() < 0.3) bytes.resize(19 + stream.below(static_cast<std::uint32_t>(bytes.size() - 19)));
      try {
        auto const table = read_table(data_test::write("bad.mat", bytes), recording_section());
        for (auto const& column : table.columns) ASSERT_EQ(column.size(), table.columns.front().size());
      } catch (Error const& error) {
        ASSERT_EQ(error.code(), ExitCode::bad_data);
      }
    }
  }
}

}  // namespace mat5_test
}  // namespace torquescope
