// The reader of numpy's arrays: files as numpy writes them (made by hand here; tests/jobs makes them with numpy).

#include <zlib.h>

#include <bit>
#include <cmath>

#include "engine/base/digest.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/data/npy_array.hpp"
#include "engine/data/zip_archive.hpp"
#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace npz_test {

using data_test::problem_of;
using data_test::recording_section;
using data_test::write;

std::string little(std::uint64_t value, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xffU));
  return bytes;
}

std::string turned(std::string bytes) { return {bytes.rbegin(), bytes.rend()}; }

// one member of a zip file in the making
struct Member {
  std::string name, bytes;
  bool packed = false;
};

std::string deflate_raw(std::string const& bytes) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  return out;
}

std::string zip_of(std::vector<Member> const& members) {
  std::string file, directory;
  for (auto const& member : members) {
    std::string const stored = member.packed ? deflate_raw(member.bytes) : member.bytes;
    auto const sum =
        crc32(0L, reinterpret_cast<Bytef const*>(member.bytes.data()), static_cast<uInt>(member.bytes.size()));
    std::string const facts = little(20, 2) + little(0, 2) + little(member.packed ? 8 : 0, 2) + little(0, 4) +
                              little(sum, 4) + little(stored.size(), 4) + little(member.bytes.size(), 4) +
                              little(member.name.size(), 2);
    directory += "PK\x01\x02" + little(20, 2) + facts + little(0, 2) + little(0, 2) + little(0, 2) + little(0, 2) +
                 little(0, 4) + little(file.size(), 4) + member.name;
    file += "PK\x03\x04" + facts + little(0, 2) + member.name + stored;
  }
  std::size_t const n = members.size();
  return file + directory + "PK\x05\x06" + little(0, 4) + little(n, 2) + little(n, 2) + little(directory.size(), 4) +
         little(file.size(), 4) + little(0, 2);
}

std::string npy(std::string const& type, std::string const& shape, std::string const& data, bool fortran = false) {
  std::string header =
      "{'descr': " + type + ", 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': " + shape + ", }";
  header.resize(117, ' ');
  header += '\n';
  return "\x93NUMPY" + std::string("\x01\x00", 2) + little(header.size(), 2) + header + data;
}

std::string f8(std::vector<double> const& values) {
  std::string bytes;
  for (double value : values) bytes += little(std::bit_cast<std::uint64_t>(value), 8);
  return bytes;
}

RawTable read_bytes(std::string const& bytes) { return read_table(write("arm.npz", bytes), recording_section()); }
std::string reason_of(RawTable const& table, std::string const& name) {
  for (auto const& column : table.unusable)
    if (column.name == name) return column.reason;
  return "(usable)";
}

TEST(NpzReader, ReadsStoredAndDeflatedMembers) {
  for (bool const packed : {false, true}) {
    auto const bytes = zip_of({{"t.npy", npy("'<f8'", "(3,)", f8({0, 0.5, 1})), packed},
                               {"q.npy", npy("'<f8'", "(3, 2)", f8({1, 2, 3, 4, 5, 6})), packed},
                               {"k.npy", npy("'<f8'", "(3, 2)", f8({1, 2, 3, 4, 5, 6}), true), packed},
                               {"readme.txt", "no array", packed}});
    auto const table = read_bytes(bytes);
    EXPECT_EQ(table.names, (std::vector<std::string>{"t", "q[0]", "q[1]", "k[0]", "k[1]"}));
    EXPECT_EQ(table.columns[0], (std::vector<double>{0, 0.5, 1}));
    EXPECT_EQ(table.columns[1], (std::vector<double>{1, 3, 5}));
    EXPECT_EQ(table.columns[3], (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(table.sha256, sha256_hex(bytes));
  }
}

TEST(NpyArray, AllNumbersOfEitherByteOrderAreRead) {
  auto const value = [](std::string const& type, std::string const& data) {
    std::string const bytes = npy("'" + type + "'", "(1,)", data);
    auto const array = read_npy(bytes, "a.npy", "a.npy");
    EXPECT_EQ(array.fields[0].objection, "");
    return npy_value(array, array.fields[0], 0);
  };
  EXPECT_EQ(value("<f8", f8({-2.5})), -2.5);
  EXPECT_EQ(value(">f8", turned(f8({-2.5}))), -2.5);
  EXPECT_EQ(value("<f4", little(std::bit_cast<std::uint32_t>(0.5F), 4)), 0.5);
  EXPECT_EQ(value(">f4", turned(little(std::bit_cast<std::uint32_t>(0.5F), 4))), 0.5);
  EXPECT_EQ(value("<f2", little(0xc100, 2)), -2.5);
  EXPECT_EQ(value("<f2", little(0x0001, 2)), std::ldexp(1.0, -24));
  EXPECT_TRUE(std::isinf(value("<f2", little(0x7c00, 2))));
  EXPECT_TRUE(std::isnan(value("<f2", little(0x7e00, 2))));
  for (std::size_t const size : {1U, 2U, 4U, 8U}) {
    auto const digit = std::to_string(size);
    EXPECT_EQ(value("<i" + digit, little(static_cast<std::uint64_t>(-3), size)), -3.0);
    EXPECT_EQ(value(">i" + digit, turned(little(static_cast<std::uint64_t>(-3), size))), -3.0);
    EXPECT_EQ(value("<u" + digit, little(200, size)), 200.0);
    EXPECT_EQ(value(">u" + digit, turned(little(200, size))), 200.0);
  }
  EXPECT_EQ(value("|b1", little(1, 1)), 1.0);
  EXPECT_EQ(value("<M8[ns]", little(1500000000, 8)), 1.5);
  EXPECT_EQ(value("<m8[ms]", little(static_cast<std::uint64_t>(-1500), 8)), -1.5);
  EXPECT_TRUE(std::isnan(value("<M8[s]", little(std::uint64_t{1} << 63, 8))));
}

TEST(NpzReader, FieldsOfStructuredArraysAreColumns) {
  std::string const item = f8({0.25}) + little(7, 2) + std::string(6, '\0') + f8({1, 2});
  auto const table =
      read_bytes(npy("[('t', '<f8'), ('n', '<u2'), ('', '|V6'), ('q', '<f8', (2,))]", "(2,)", item + item));
  EXPECT_EQ(table.names, (std::vector<std::string>{"t", "n", "q[0]", "q[1]"}));
  EXPECT_EQ(table.columns[1], (std::vector<double>{7, 7}));
  EXPECT_EQ(table.columns[3], (std::vector<double>{2, 2}));
}

TEST(NpzReader, WhatHoldsNoSignalSaysWhy) {
  auto const table = read_bytes(zip_of({{"t.npy", npy("'<f8'", "(2,)", f8({0, 1}))},
                                        {"one.npy", npy("'<f8'", "()", f8({0}))},
                                        {"cube.npy", npy("'<f8'", "(1, 1, 2)", f8({0, 1}))},
                                        {"none.npy", npy("'<f8'", "(0,)", "")},
                                        {"text.npy", npy("'<U3'", "(2,)", std::string(24, 'a'))},
                                        {"object.npy", npy("'|O'", "(2,)", "a pickle")},
                                        {"both.npy", npy("[('a', '<f8'), ('b', '|O')]", "(2,)", "a pickle")},
                                        {"complex.npy", npy("'<c16'", "(1,)", f8({0, 1}))},
                                        {"long.npy", npy("'<f16'", "(1,)", f8({0, 1}))}}));
  EXPECT_EQ(table.names, (std::vector<std::string>{"t"}));
  EXPECT_EQ(reason_of(table, "one"), "is one number, not a signal");
  EXPECT_EQ(reason_of(table, "cube"), "has 3 dimensions (a signal has 1, a table of signals 2)");
  EXPECT_EQ(reason_of(table, "none"), "is empty");
  EXPECT_EQ(reason_of(table, "text"), "is text");
  EXPECT_EQ(reason_of(table, "object"), "holds Python objects (a pickle); save it as float64");
  EXPECT_EQ(reason_of(table, "both"), "holds Python objects (a pickle); save it as float64");
  EXPECT_EQ(reason_of(table, "complex"), "is complex");
  EXPECT_EQ(reason_of(table, "long"), "holds floating-point numbers of 16 bytes; save it as float64");
}

TEST(NpzReader, SizesBeyondTheFileAreRefusedBeforeAnythingIsAllocated) {
  for (auto const* shape : {"(4,)", "(1000000000000,)", "(4294967296, 4294967296)", "(2, 9223372036854775807)"}) {
    auto const problem = problem_of([&] { read_bytes(npy("'<f8'", shape, f8({0, 1, 2}))); });
    EXPECT_EQ(problem.code, ExitCode::bad_data);
    EXPECT_NE(problem.what.find("claims more numbers than its bytes hold"), std::string::npos) << shape;
  }
}

TEST(ZipArchive, OtherKindsOfZipAreRefusedInWords) {
  auto const what = [](std::string const& bytes) { return problem_of([&] { read_bytes(bytes); }).what; };
  auto const good = zip_of({{"t.npy", npy("'<f8'", "(2,)", f8({0, 1})), true}});
  auto const with = [&](std::size_t from_end, std::string const& bytes) {
    std::string changed = good;
    return changed.replace(changed.size() - from_end, bytes.size(), bytes);
  };
  constexpr std::size_t end = 22, entry = end + 51;
  EXPECT_NE(what(with(end - 16, "\xff\xff\xff\xff")).find("zip64"), std::string::npos);
  EXPECT_NE(what(with(entry - 24, "\xff\xff\xff\xff")).find("zip64"), std::string::npos);
  EXPECT_NE(what(with(entry - 8, std::string("\x01\x00", 2))).find("encrypted"), std::string::npos);
  EXPECT_NE(what(with(entry - 10, std::string("\x0e\x00", 2))).find("method 14"), std::string::npos);
  EXPECT_NE(what(with(entry - 24, std::string("\x00\x00\x00\x7f", 4))).find("claims more"), std::string::npos);
  EXPECT_NE(what(good.substr(0, good.size() / 2)).find("cut short"), std::string::npos);
  std::string flipped = good;
  flipped[good.find("t.npy") + 60] = static_cast<char>(flipped[good.find("t.npy") + 60] ^ 4);
  EXPECT_NE(what(flipped).find("is damaged in \"t.npy\""), std::string::npos);
  auto const excel = problem_of([&] {
    read_bytes(zip_of({{"[Content_Types].xml", "<x/>"}, {"xl/workbook.xml", "<x/>"}}));
  });
  EXPECT_TRUE(excel.what.ends_with("is a workbook of Excel"));
  ASSERT_EQ(excel.notes.size(), 1u);
  EXPECT_NE(excel.notes[0].find("read_excel("), std::string::npos);
}

// a name is a name: nothing is ever written
TEST(NpzReader, NamesWithPathsAreColumns) {
  auto const outside = data_test::folder() / ".." / "escaped.npy";
  auto const bytes = zip_of({{"../escaped.npy", npy("'<f8'", "(2,)", f8({0, 1}))},
                             {"/etc/joint/q.npy", npy("'<f8'", "(2,)", f8({2, 3}))},
                             {std::string("a\0b\n.npy", 8), npy("'<f8'", "(2,)", f8({4, 5}))}});
  auto const table = read_bytes(bytes);
  EXPECT_EQ(table.names, (std::vector<std::string>{"../escaped", "/etc/joint/q", std::string("a\0b\n", 4)}));
  EXPECT_FALSE(std::filesystem::exists(outside));
}

TEST(NpzReader, EveryTruncationIsRefused) {
  auto const whole =
      zip_of({{"t.npy", npy("'<f8'", "(2,)", f8({0, 1}))}, {"q.npy", npy("'<f8'", "(2,)", f8({2, 3})), true}});
  for (std::size_t size = 1; size < whole.size(); size += 7)
    EXPECT_EQ(problem_of([&] { read_bytes(whole.substr(0, size)); }).code, ExitCode::bad_data) << size;
}

// random damage either still reads or is refused with exit code 65; nothing else escapes
TEST(NpzReader, RandomBytesNeverEscapeAsAnythingButAnError) {
  std::string const plain = npy("'<f8'", "(3, 2)", f8({1, 2, 3, 4, 5, 6}));
  std::string const files[] = {plain, npy("[('t', '<f8'), ('q', '<f4', (2,))]", "(2,)", std::string(32, 'x')),
                               zip_of({{"t.npy", plain}, {"q.npy", plain, true}})};
  int n_read = 0, n_refused = 0;
  for (std::uint32_t trial = 0; trial < 3000; ++trial) {
    RandomStream stream({13, 0, RandomDomain::test}, 0, trial);
    std::string bytes = files[trial % 3];
    for (std::uint32_t k = stream.below(4); k-- > 0;)
      bytes[stream.below(static_cast<std::uint32_t>(bytes.size()))] = static_cast<char>(stream.below(256));
    if (stream.below(3) == 0) bytes.resize(stream.below(static_cast<std::uint32_t>(bytes.size())) + 1);
    try {
      auto const table = read_bytes(bytes);
      for (auto const& column : table.columns) ASSERT_EQ(column.size(), table.columns.front().size());
      ++n_read;
    } catch (Error const& error) {
      ASSERT_EQ(error.code(), ExitCode::bad_data);
      ++n_refused;
    }
  }
  EXPECT_GT(n_read, 300);
  EXPECT_GT(n_refused, 300);
}

}  // namespace npz_test
}  // namespace torquescope
