// The reader of JSON: however a table is nested, it is the same table; damage has its line.

#include <gmock/gmock.h>

#include <cmath>

#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace json_test {

using data_test::problem_of;
using data_test::recording_section;
using data_test::write;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

RawTable read_text(std::string const& text) { return read_table(write("arm.json", text), recording_section()); }
Problem refused(std::string const& text) {
  return problem_of([&] { read_text(text); });
}

void expect_the_table(RawTable const& table) {
  ASSERT_THAT(table.names, ElementsAre("t", "q", "tau"));
  EXPECT_THAT(table.columns[0], ElementsAre(0, 0.5, 1));
  EXPECT_THAT(table.columns[1], ElementsAre(1.5, -2e-3, 4));
  EXPECT_THAT(table.columns[2], ElementsAre(-1, 0, 1000));
}

TEST(JsonReader, RecordsLinesAndColumnsAreTheSameTable) {
  expect_the_table(read_text(R"([{"t":0,"q":1.5,"tau":-1},{"t":0.5,"q":-2e-3,"tau":0},{"t":1,"q":4,"tau":1e3}])"));
  expect_the_table(
      read_text("{\"t\":0,\"q\":1.5,\"tau\":-1}\n\n{\"t\":0.5,\"q\":-2e-3,\"tau\":0}\r\n"
                "{\"t\":1,\"q\":\"4\",\"tau\":1e3}"));
  expect_the_table(read_text("\xef\xbb\xbf{\"t\" :[0,0.5,1],\n \"q\" :[1.5,-2e-3,4],\n \"tau\" :[-1,0,1e3]}"));
  expect_the_table(
      read_text(R"({"t":{"0":0,"1":0.5,"2":1},"q":{"0":1.5,"1":-0.002,"2":4},"tau":{"0":-1,"1":0,"2":1000}})"));
  expect_the_table(
      read_text(R"({"meta":{"n":3,"by":"x"},"t":[0,0.5,1],"q":[1.5,-2e-3,4],"tau":[-1,0,1e3],"limits":[1,2]})"));
}

TEST(JsonReader, KeysAndListsAreNames) {
  auto const table =
      read_text(R"({"run":[{"t":0,"joint":{"q":[1,2],"on":true}},{"t":1,"joint":{"q":[3,4],"on":false}}]})");
  EXPECT_THAT(table.names, ElementsAre("run/t", "run/joint/q[0]", "run/joint/q[1]", "run/joint/on"));
  EXPECT_THAT(table.columns[2], ElementsAre(2, 4));
  EXPECT_THAT(table.columns[3], ElementsAre(1, 0));
}

TEST(JsonReader, MissingValuesAreNoNumbersAndTextIsUnusable) {
  auto const table = read_text(
      "[{\"t\":0,\"q\":NaN,\"mode\":\"run, "
      "NaN\"},\n{\"t\":1,\"q\":-Infinity},\n{\"t\":2,\"q\":null},{\"t\":3,\"q\":7}]");
  EXPECT_THAT(table.names, ElementsAre("t", "q"));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(std::isnan(table.columns[1][k]));
  EXPECT_EQ(table.columns[1][3], 7);
  ASSERT_EQ(table.unusable.size(), 1u);
  EXPECT_EQ(table.unusable[0].name, "mode");
  EXPECT_THAT(table.unusable[0].reason, HasSubstr("\"run, NaN\" in record 1"));
}

TEST(JsonReader, DamageHasItsLine) {
  EXPECT_EQ(refused("[{\"t\":0},\n{\"t\":1},\n{\"t\":oops}]").place.line, 3);
  EXPECT_EQ(refused("[{\"t\":0},\n{\"t\":1},\n").place.line, 3);
  EXPECT_EQ(refused("{\"t\":0}\n{\"t\":}\n{\"t\":2}\n").place.line, 2);
  auto const cut = read_text("{\"t\":0,\"q\":1}\n{\"t\":1,\"q\":2}\n{\"t\":2,\"q\"");
  EXPECT_THAT(cut.columns[0], ElementsAre(0, 1));
  EXPECT_THAT(cut.remarks, testing::Contains(HasSubstr("The last line, 3, was cut short")));
  EXPECT_THAT(cut.line_of_row, ElementsAre(1, 2));
  EXPECT_THAT(refused("{\"robot\": {\"name\": \"x\"}}").what, HasSubstr("holds no columns of numbers"));
  std::string deep(2000, '[');
  EXPECT_THAT(refused(deep).what, HasSubstr("nests deeper"));
}

}  // namespace json_test
}  // namespace torquescope
