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

TEST(CsvReader, NamesThatRepeatBelongToTheGroupsAboveThem) {
  std::vector<std::string> const names{"Time", "Axis 1.Position", "Axis 1.Torque", "Axis 2.Position", "Axis 2.Torque"};
  std::string const groups = ",Axis 1,,Axis 2,\n", header = "Time,Position,Torque,Position,Torque\n",
                    rows = "0,1,2,3,4\n1,2,3,4,5\n2,3,4,5,6\n";
  EXPECT_EQ(read_text(groups + header + rows).names, names);
  auto const with_units = read_text("Log of Monday\n" + groups + header + "s,deg,Nm,deg,Nm\n" + rows);
  EXPECT_EQ(with_units.names, names);
  EXPECT_EQ(with_units.units, (std::vector<std::string>{"s", "deg", "Nm", "deg", "Nm"}));
  // names that differ need no groups
  EXPECT_EQ(read_text(",Axis 1,\nTime,Position,Torque\n0,1,2\n1,2,3\n2,3,4\n").names[1], "Position");
}

TEST(CsvReader, ListsInCellsBecomeColumns) {
  std::vector<std::string> const names{"t_s", "state[0]", "state[1]", "action[0]", "action[1]"};
  for (std::string const text : {"t_s,state,action\n0,\"[1.5, 2]\",\"[3,4]\"\n1,\"[-2.5e-3, 3]\",\"[5,6]\"\n",
                                 "t_s,state,action\n0,[1.5, 2],[3, 4]\n1,[-2.5e-3, 3],[5, 6]",
                                 "t_s;state;action\n0;[ 1.5  2. ];[3 4]\n1;[-2.5e-3 3];[5 6]\n",
                                 "t_s\tstate\taction\n0\t[1.5; 2]\t[3; 4]\n1\t[-2.5e-3; 3]\t[5; 6]\n"}) {
    auto const table = read_text(text);
    EXPECT_EQ(table.names, names) << text;
    ASSERT_EQ(table.columns.size(), names.size());
    EXPECT_EQ(table.columns[1], (std::vector<double>{1.5, -2.5e-3}));
    EXPECT_EQ(table.columns[4], (std::vector<double>{4, 6}));
    EXPECT_TRUE(table.unusable.empty());
  }
  // a list of another length is text, and said; empty columns stay columns
  auto const odd = read_text("t_s,state\n0,\"[1, 2]\"\n1,\"[1, 2, 3]\"\n2,\"[1, 2]\"\n");
  EXPECT_EQ(odd.names, std::vector<std::string>{"t_s"});
  ASSERT_EQ(odd.unusable.size(), 2u);
  EXPECT_NE(odd.unusable[0].reason.find("line 3"), std::string::npos);
  EXPECT_EQ(read_text("a\t\tb\n1\t\t2\n3\t\t4\n").columns.size(), 3u);
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

TEST(CsvReader, EmptyCellsAndWordsForNoNumberAreMissing) {
  auto const table = read_text("a,b,c\n1,,3\nNaN,NA,\n4,null,inf\n");
  EXPECT_TRUE(std::isnan(table.columns[1][0]));
  EXPECT_TRUE(std::isnan(table.columns[0][1]));
  EXPECT_TRUE(std::isnan(table.columns[2][1]));
  EXPECT_TRUE(std::isinf(table.columns[2][2]));
}

TEST(CsvReader, ProgramsSayNoNumberInManyWords) {
  for (auto const* word : {"None", "NULL", "N/A", "--", "-", "-nan", "nan(ind)", "-1.#IND", "1.#QNAN", "-1.#IND00",
                           "#N/A", "<NA>", "NaT"}) {
    auto const table = read_text(std::string("t,q\n0,1\n1,") + word + "\n2,3\n");
    ASSERT_EQ(table.columns.size(), 2u) << word;
    EXPECT_TRUE(std::isnan(table.columns[1][1])) << word;
  }
  auto const table = read_text("t,q\n0,1.#INF\n1,-1.#INF\n2,-inf\n3,0\n");
  EXPECT_EQ(table.columns[1][0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(table.columns[1][1], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(table.columns[1][2], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(read_text("t,q\n0,1\n1,1.#off\n2,2\n").unusable[0].reason, "holds text: \"1.#off\" in line 3");
}

TEST(CsvReader, DecimalCommasAreReadWhereNoCommaSeparates) {
  std::string const text = "t_s;q_rad;tau\n0;1,5;-1\n0,001;-2,5e-3;0\n0,002;+4;1e3\n";
  auto const tabs = [&] {
    std::string replaced = text;
    std::replace(replaced.begin(), replaced.end(), ';', '\t');
    return replaced;
  };
  std::string const remark = "Decimal commas were read as decimal points (first: 1,5 in line 2).";
  for (auto const& table : {read_text(text), read_text(tabs())}) {
    expect_the_table(table);
    EXPECT_EQ(table.remarks, (std::vector<std::string>{remark}));
  }
  expect_the_table(read_text("t_s,q_rad,tau\n0,\"1,5\",-1\n\"0,001\",\"-2,5e-3\",0\n\"0,002\",4,1e3\n"));
  // names that hold more commas than separators
  auto const named = read_text("t, s;q, rad\n0,0;1,5\n0,1;1,75\n0,2;2,5\n");
  EXPECT_EQ(named.names, (std::vector<std::string>{"t, s", "q, rad"}));
  EXPECT_EQ(named.columns[1], (std::vector<double>{1.5, 1.75, 2.5}));
}

TEST(CsvReader, TwoDecimalMarksInOneFileAreRefused) {
  auto const problem = refused("t;q\n0.5;1\n1.0;2\n1.5;1,234\n");
  EXPECT_EQ(problem.what, "1,234 in line 4 has a decimal comma, a number in line 2 a decimal point");
  EXPECT_EQ(problem.place.line, 4);
}

TEST(CsvReader, UnitsBelowTheNamesAreKept) {
  auto const table = read_text("t_s,q_rad,tau\n[s],(rad),Nm\n0,1.5,-1\n0.001,-2.5e-3,0\n0.002,4,1e3\n");
  expect_the_table(table);
  EXPECT_EQ(table.units, (std::vector<std::string>{"s", "rad", "Nm"}));
  EXPECT_EQ(table.remarks, (std::vector<std::string>{"Line 2 was read as the units of the columns."}));
  EXPECT_EQ(table.line_of_row.front(), 3);
  // an unknown unit among known ones, a text column, a degree sign of ISO 8859-1
  auto const more = read_text("t;mode;q;f\ns;-;\xb0;furlong\n0;run;1;2\n1;run;2;2\n2;run;3;2\n");
  EXPECT_EQ(more.names, (std::vector<std::string>{"t", "q", "f"}));
  EXPECT_EQ(more.units, (std::vector<std::string>{"s", "\xc2\xb0", "furlong"}));
  EXPECT_TRUE(read_text("t,q\n0,1\n").units.empty());
}

TEST(CsvReader, WordsBelowTheNamesAreSkipped) {
  auto const table =
      read_text("t_s,q_rad,tau\ntime,angle of joint,torque of motor\n0,1.5,-1\n0.001,-2.5e-3,0\n0.002,4,1e3\n");
  expect_the_table(table);
  EXPECT_TRUE(table.units.empty());
  EXPECT_EQ(table.remarks, (std::vector<std::string>{"Line 2 holds no numbers and was skipped."}));
  // a row of groups above the names
  expect_the_table(read_text(",joint 1,joint 1\nt_s,q_rad,tau\n0,1.5,-1\n0.001,-2.5e-3,0\n0.002,4,1e3\n"));
}

TEST(CsvReader, PreambleOfALoggerIsSkipped) {
  std::string const rows = "t_s;q_rad;tau\n0;1.5;-1\n0.001;-2.5e-3;0\n0.002;4;1e3\n";
  for (std::string const preamble : {"Name;Scope Project\nFile;C:/run.x\nStart;15.01.2026 10:29:04\n\n",
                                     "Sample rate;1000\nChannels;3\nGain;1\nOffset;0\n",
                                     "Exported, by a program, of 2024\n1000\n\n\n", "A title\n"}) {
    auto const table = read_text(preamble + rows);
    expect_the_table(table);
    ASSERT_EQ(table.remarks.size(), 1u) << preamble;
    EXPECT_NE(table.remarks[0].find("above the column names"), std::string::npos);
  }
  auto const units = read_text("Scope\n\nt_s\tq_rad\ttau\ns\trad\tNm\n0\t1,5\t-1\n0,001\t-2,5e-3\t0\n0,002\t4\t1e3\n");
  expect_the_table(units);
  EXPECT_EQ(units.remarks.size(), 3u);
}

TEST(CsvReader, NothingIsSkippedBelowTheFirstRow) {
  // a text column whose first word stands in the first rows, not a second line of names
  auto const table = read_text("t,mode\n0,off\n1,2\n2,3\n3,4\n");
  EXPECT_EQ(table.columns[0].size(), 4u);
  EXPECT_EQ(table.unusable[0].reason, "holds text: \"off\" in line 2");
  EXPECT_TRUE(table.remarks.empty());
}

TEST(CsvReader, DatesAndClocksBecomeSeconds) {
  auto const dates =
      read_text("t,q\n2024-05-01 12:00:00.000,1\n2024-05-01 12:00:00.002,2\n2024-05-01 12:00:00.004,3\n");
  ASSERT_EQ(dates.columns.size(), 2u);
  EXPECT_EQ(dates.columns[0][0], 1714564800.0);
  EXPECT_NEAR(dates.columns[0][2] - dates.columns[0][0], 0.004, 1e-6);
  EXPECT_EQ(dates.remarks, (std::vector<std::string>{"\"t\" holds dates with times: read as seconds since 1970."}));
  auto const clocks = read_text("t,q\n23:59:59.5,1\n23:59:59.75,2\n00:00:00,3\n00:00:00.25,3\n");
  EXPECT_EQ(clocks.columns[0], (std::vector<double>{86399.5, 86399.75, 86400, 86400.25}));
  // numbers and times in one column are neither
  EXPECT_EQ(read_text("t,q\n0.5,1\n12:00:00,2\n1,3\n").unusable.size(), 1u);
  EXPECT_EQ(read_text("t,q\n12:00:00,1\n0.5,2\n12:00:01,3\n").unusable.size(), 1u);
  // names in the comment above stamps
  EXPECT_EQ(read_text("# t,q\n12:00:00,1\n12:00:01,2\n").names.front(), "t");
}

TEST(CsvReader, LastLineThatWasCutShortIsLeftOut) {
  std::string const rows = "t_s,q_rad,tau\n0,1.5,-1\n0.001,-2.5e-3,0\n0.002,4,1e3\n";
  for (std::string const torn :
       {"0.003,4", "0.003,4\n", "0.003,4,-", "0.003,4,1e-", "0.003,4,", "0.0", "# x\n0.0\n\n"}) {
    auto const table = read_text(rows + torn);
    expect_the_table(table);
    ASSERT_EQ(table.remarks.size(), 1u) << torn;
    EXPECT_NE(table.remarks[0].find("was cut short"), std::string::npos);
  }
  EXPECT_EQ(refused(rows + "0.003,4\n0.004,4,1\n").place.line, 5);
  // a missing last number is no torn line when the line was ended
  EXPECT_EQ(read_text(rows + "0.003,4,\n").columns[0].size(), 4u);
}

TEST(CsvReader, EmptyRowsAndZeroBytesAtTheEndAreLeftOut) {
  std::string const rows = "t_s,q_rad,tau\n0,1.5,-1\n0.001,-2.5e-3,0\n0.002,4,1e3\n";
  auto const spreadsheet = read_text(rows + ",,\n,,\n");
  expect_the_table(spreadsheet);
  EXPECT_EQ(spreadsheet.line_of_row.size(), 3u);
  auto const power_cut = read_text(rows + std::string(5000, '\0'));
  expect_the_table(power_cut);
  EXPECT_EQ(power_cut.remarks,
            (std::vector<std::string>{"The file ends in 5000 zero bytes, as after a power cut: they are left out."}));
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
  auto const ragged = refused("a,b,c\n1,2,3\n4,5\n6,7,8\n");
  EXPECT_EQ(ragged.code, ExitCode::bad_data);
  EXPECT_EQ(ragged.what, "line 3 has 2 cells, the header 3");
  EXPECT_EQ(ragged.place.line, 3);
  EXPECT_EQ(ragged.place.line_text, "4,5");
  EXPECT_TRUE(ragged.place.file.ends_with("arm.csv"));

  EXPECT_NE(refused("a,b\n1,5,2,5\n").help.find("decimal comma"), std::string::npos);

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

  auto const words = refused("t,q\n0,1\nstopped,by hand\n1,2\n");
  EXPECT_EQ(words.what, "\"stopped\" in line 3 is not a number");
}

TEST(CsvReader, Utf16IsReadInEitherByteOrder) {
  std::string const text = "t_s,q_rad,tau\r\n0,1.5,-1\r\n0.001,-2.5e-3,0\r\n0.002,4,1e3\r\n";
  std::string little, big;
  for (char letter : text) {
    little += {letter, '\0'};
    big += {'\0', letter};
  }
  for (auto const& bytes : {"\xff\xfe" + little, "\xfe\xff" + big, little, big}) {
    auto const table = read_text(bytes);
    expect_the_table(table);
    EXPECT_EQ(table.remarks, (std::vector<std::string>{"The text is UTF-16 and was read as such."}));
  }
  EXPECT_EQ(read_text(std::string("\xff\xfe\xb0\0,\0q\0\n\0\x31\0,\0\x32\0", 16)).names.front(), "\xc2\xb0");
  EXPECT_TRUE(refused(std::string("\xff\xfet\0,", 5)).what.ends_with("is damaged UTF-16 text"));
  EXPECT_TRUE(refused(std::string("\xff\xfe\0\xd8,\0", 6)).what.ends_with("is damaged UTF-16 text"));
}

TEST(CsvReader, RefusesWhatIsNoText) {
  auto const late_zero = refused("t,q\n" + std::string(5000, '1') + std::string("\0", 1) + ",2\n");
  EXPECT_NE(late_zero.what.find("zero bytes"), std::string::npos);
  auto const unknown = refused(std::string("\x01\x02\0\0\x03\x04", 6));
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
