// The reader of delimited text: every usual way to write a table gives the same table, every damage its message.

#include <zlib.h>

#include <charconv>
#include <cmath>

#include "engine/base/digest.hpp"
#include "engine/base/random_stream.hpp"
#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace csv_test {

using data_test::problem_of;
using data_test::recording_section;
using data_test::write;

RawTable read_text(std::string const& text) { return read_table(write("arm.csv", text), recording_section()); }
Problem refused(std::string const& text) {
  return problem_of([&] { read_text(text); });
}

void expect_the_table(RawTable const& table) {
  EXPECT_EQ(table.names, (std::vector<std::string>{"t_s", "q_rad", "tau"}));
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[0], (std::vector<double>{0, 0.001, 0.002}));
  EXPECT_EQ(table.columns[1], (std::vector<double>{1.5, -2.5e-3, 4}));
  EXPECT_EQ(table.columns[2], (std::vector<double>{-1, 0, 1e3}));
}

TEST(CsvReader, AllUsualSpellingsGiveTheSameTable) {
  std::string const plain = "t_s,q_rad,tau\n0,1.5,-1\n0.001,-2.5e-3,0\n0.002,+4,1e3\n";
  expect_the_table(read_text(plain));
  auto const replaced = [&](char separator) {
    std::string text = plain;
    std::replace(text.begin(), text.end(), ',', separator);
    return text;
  };
  expect_the_table(read_text(replaced(';')));
  expect_the_table(read_text(replaced('\t')));
  expect_the_table(read_text(replaced(' ')));
  expect_the_table(read_text("  t_s   q_rad tau \n 0  1.5 -1\n\n0.001 -2.5e-3\t0\n0.002  4    1e3"));
  expect_the_table(read_text("\xef\xbb\xbft_s,q_rad,tau\r\n0,1.5,-1\r\n0.001,-2.5e-3,0\r\n0.002,4,1e3\r\n"));
  expect_the_table(read_text("t_s,q_rad,tau\r0,1.5,-1\r0.001,-2.5e-3,0\r0.002,4,1e3\r"));
  expect_the_table(read_text("\"t_s\", \"q_rad\" ,\"tau\"\n\"0\",1.5,-1\n0.001,-2.5e-3,0\n0.002,4,\"1e3\"\n"));
  expect_the_table(read_text("t_s,q_rad,tau,\n0,1.5,-1,\n0.001,-2.5e-3,0,\n0.002,4,1e3\n"));
  expect_the_table(read_text("# a robot\n\nt_s,q_rad,tau\n# begin\n0,1.5,-1\n0.001,-2.5e-3,0\n0.002,4,1e3\n# end"));
  expect_the_table(read_text("# a robot\n# t_s,q_rad,tau\n0,1.5,-1\n0.001,-2.5e-3,0\n0.002,4,1e3\n"));  // numpy.savetxt
}

TEST(CsvReader, GzipGivesTheTableAndTheDigestOfItsOwnBytes) {
  auto const path = data_test::folder() / "arm.csv.gz";
  std::string const text = "t_s,q_rad,tau\n0,1.5,-1\n0.001,-2.5e-3,0\n0.002,4,1e3\n";
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  auto const table = read_table(path, recording_section());
  expect_the_table(table);
  std::ifstream stream(path, std::ios::binary);
  std::string const bytes{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(table.sha256, sha256_hex(bytes));
}

TEST(CsvReader, KeepsTheLineOfEveryRow) {
  auto const table = read_text("# one\n\na,b\n1,2\n# two\n\n3,4\r\n5,6\n");
  EXPECT_EQ(table.line_of_row, (std::vector<std::int64_t>{4, 7, 8}));
}

TEST(CsvReader, QuotedNamesMayHoldSeparatorsAndQuotes) {
  auto const table = read_text("\"torque, motor\",\"the \"\"real\"\" q\",\n1,2,\n4,5\n");
  EXPECT_EQ(table.names[0], "torque, motor");
  EXPECT_EQ(table.names[1], "the \"real\" q");
}

TEST(CsvReader, ColumnsWithoutNameAreNumbered) {
  EXPECT_EQ(read_text(",q,tau\n0,1,2\n").names[0], "column 1");  // pandas.to_csv
}

TEST(CsvReader, EmptyCellsAndNansAreMissing) {
  auto const table = read_text("a,b,c\n1,,3\nNaN,NA,\n4,null,inf\n");
  EXPECT_TRUE(std::isnan(table.columns[1][0]));
  EXPECT_TRUE(std::isnan(table.columns[0][1]));
  EXPECT_TRUE(std::isnan(table.columns[2][1]));
  EXPECT_TRUE(std::isinf(table.columns[2][2]));
}

TEST(CsvReader, NumbersBeyondDoubleAreZeroOrInfinite) {
  auto const table = read_text("a,b\n1e-400,1e400\n");
  EXPECT_EQ(table.columns[0][0], 0.0);
  EXPECT_TRUE(std::isinf(table.columns[1][0]));
}

TEST(CsvReader, ReadsEveryDoubleBackBitForBit) {
  std::string text = "x,y\n";
  std::vector<double> written;
  RandomStream stream({11, 0, RandomDomain::test}, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    double const value = std::ldexp(stream.uniform(-1, 1), static_cast<int>(stream.below(200)) - 100);
    char letters[64];
    auto const end = std::to_chars(letters, letters + sizeof letters, value).ptr;
    text += std::string(letters, end) + ",0\n";
    written.push_back(value);
  }
  EXPECT_EQ(read_text(text).columns[0], written);
}

TEST(CsvReader, TextColumnIsUnusableWithItsFirstLine) {
  auto const table = read_text("t,mode,q\n0,run,1\n1,run,2\n");
  EXPECT_EQ(table.names, (std::vector<std::string>{"t", "q"}));
  ASSERT_EQ(table.unusable.size(), 1u);
  EXPECT_EQ(table.unusable[0].name, "mode");
  EXPECT_EQ(table.unusable[0].reason, "holds text: \"run\" in line 2");
  EXPECT_EQ(table.unusable[0].line, 2);
}

TEST(CsvReader, DamagedTextNamesItsLineAndTheWayOut) {
  auto const ragged = refused("a,b,c\n1,2,3\n4,5\n");
  EXPECT_EQ(ragged.code, ExitCode::bad_data);
  EXPECT_EQ(ragged.what, "line 3 has 2 cells, the header 3");
  EXPECT_EQ(ragged.place.line, 3);
  EXPECT_EQ(ragged.place.line_text, "4,5");
  EXPECT_TRUE(ragged.place.file.ends_with("arm.csv"));

  EXPECT_NE(refused("a,b\n1,5,2,5\n").help.find("decimal comma"), std::string::npos);
  EXPECT_NE(refused("a;b\n1,5;2,5\n").help.find("decimal comma"), std::string::npos);

  auto const empty = refused("");
  EXPECT_TRUE(empty.what.ends_with("arm.csv is empty"));
  EXPECT_EQ(empty.help, "it needs a line of column names, then numbers");
  EXPECT_TRUE(refused("# only\n# comments\n").what.ends_with("is empty"));
  EXPECT_TRUE(refused("a,b\n").what.ends_with("has column names but no rows"));

  auto const no_names = refused("# from the robot\n0,1,2\n3,4,5\n");
  EXPECT_TRUE(no_names.what.ends_with("has no column names: line 2 is numbers already"));
  EXPECT_NE(no_names.help.find("write the names above them"), std::string::npos);

  auto const again = refused("t,q\n0,1\n1,2\nt,q\n0,1\n");
  EXPECT_EQ(again.what, "the header is repeated in line 4");
  EXPECT_EQ(again.help, "two recordings in one file? split it at line 4");

  auto const words = refused("t,q\n0,1\nstopped,by hand\n");
  EXPECT_EQ(words.what, "\"stopped\" in line 3 is not a number");
}

TEST(CsvReader, RefusesWhatIsNotUtf8Text) {
  auto const utf16 = refused(std::string("\xff\xfet\0,\0q\0", 8));
  EXPECT_TRUE(utf16.what.ends_with("is UTF-16 text"));
  EXPECT_NE(utf16.help.find("iconv"), std::string::npos);
  auto const late_zero = refused("t,q\n" + std::string(5000, '1') + std::string("\0", 1) + ",2\n");
  EXPECT_NE(late_zero.what.find("zero bytes"), std::string::npos);
  auto const unknown =
      refused(std::string("\x7f"
                          "ELF\0\0",
                          6));
  EXPECT_EQ(unknown.code, ExitCode::bad_data);
  EXPECT_TRUE(unknown.what.ends_with("is in no format known here"));
  EXPECT_EQ(unknown.notes.size(), reader_choices().size());
}

// random damage to a good file either still reads or is refused with exit code 65; nothing else escapes
TEST(CsvReader, RandomBytesNeverEscapeAsAnythingButAnError) {
  std::string const good = "# c\nt_s,\"q\",tau\n0,1.5,-1\n0.001,-2.5e-3,0\n0.002,4,1e3\n";
  for (std::uint32_t trial = 0; trial < 500; ++trial) {
    RandomStream stream({12, 0, RandomDomain::test}, 0, trial);
    std::string text = good;
    for (std::uint32_t k = stream.below(8); k-- > 0;)
      text[stream.below(static_cast<std::uint32_t>(text.size()))] = static_cast<char>(stream.below(256));
    text.resize(stream.below(static_cast<std::uint32_t>(text.size())) + 1);
    try {
      auto const table = read_text(text);
      for (auto const& column : table.columns) ASSERT_EQ(column.size(), table.line_of_row.size());
    } catch (Error const& error) {
      ASSERT_EQ(error.code(), ExitCode::bad_data) << text;
    }
  }
}

}  // namespace csv_test
}  // namespace torquescope
