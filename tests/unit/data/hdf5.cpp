// The reader of HDF5 and MATLAB 7.3 files.

#include <hdf5.h>

#include <cmath>

#include "engine/base/digest.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/hdf5_open_flags.hpp"
#include "engine/data/pandas_frame.hpp"
#include "unit/data/data_test_support.hpp"

namespace torquescope {
namespace hdf5_test {

using data_test::problem_of;
using data_test::recording_section;

// a small file made through the C API; identifiers are closed by H5close-like order of the destructor
class Hdf5File {
 public:
  explicit Hdf5File(std::string const& name, hsize_t user_block = 0) : path_(data_test::folder() / name) {
    hid_t const creation = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_userblock(creation, user_block);
    file_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
    H5Pclose(creation);
  }
  ~Hdf5File() { H5Fclose(file_); }
  Hdf5File(Hdf5File const&) = delete;
  Hdf5File& operator=(Hdf5File const&) = delete;
  hid_t id() const { return file_; }
  std::filesystem::path const& path() const { return path_; }

  void group(char const* name) { H5Gclose(H5Gcreate2(file_, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)); }

  void dataset(char const* name, std::vector<hsize_t> sizes, hid_t stored, hid_t given, void const* values,
               hid_t creation = H5P_DEFAULT) {
    hid_t const space = H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr);
    hid_t const id = H5Dcreate2(file_, name, stored, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (values != nullptr) H5Dwrite(id, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Dclose(id);
    H5Sclose(space);
  }
  void doubles(char const* name, std::vector<hsize_t> sizes, std::vector<double> const& values) {
    dataset(name, std::move(sizes), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
  }
  // fixed width when `width` > 0, else variable length
  void text_attribute(char const* object, char const* name, std::vector<char const*> const& texts, std::size_t width) {
    hid_t const type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, width > 0 ? width : H5T_VARIABLE);
    hsize_t const count = texts.size();
    hid_t const space = H5Screate_simple(1, &count, nullptr);
    hid_t const attribute = H5Acreate_by_name(file_, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    std::string fixed(width * texts.size(), '\0');
    for (std::size_t k = 0; width > 0 && k < texts.size(); ++k)
      fixed.replace(k * width, std::string(texts[k]).size(), texts[k]);
    H5Awrite(attribute, type, width > 0 ? static_cast<void const*>(fixed.data()) : texts.data());
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
  }

 private:
  std::filesystem::path path_;
  hid_t file_;
};

std::vector<double> ramp(std::size_t n, double from = 0.0) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = from + static_cast<double>(i);
  return values;
}

std::size_t column_of(RawTable const& table, std::string const& name) {
  auto const found = std::find(table.names.begin(), table.names.end(), name);
  EXPECT_NE(found, table.names.end()) << name;
  return static_cast<std::size_t>(found - table.names.begin());
}

std::string reason_of(RawTable const& table, std::string const& name) {
  for (auto const& column : table.unusable)
    if (column.name == name) return column.reason;
  return "(usable)";
}

// as h5py writes with track_order: the order in which joints were written, not that of the alphabet
TEST(Hdf5Order, IsThatOfTheFileWhereItKeepsOne) {
  auto const path = data_test::folder() / "order.h5";
  hid_t const creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  hid_t const file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
  hsize_t const size = 3;
  std::vector<double> const values{1.0, 2.0, 3.0};
  for (char const* name : {"wrist", "elbow", "base"}) {
    hid_t const space = H5Screate_simple(1, &size, nullptr);
    hid_t const id = H5Dcreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(id);
    H5Sclose(space);
  }
  H5Fclose(file);
  H5Pclose(creation);
  EXPECT_EQ(read_table(path, recording_section()).names, (std::vector<std::string>{"wrist", "elbow", "base"}));
}

TEST(Hdf5Reader, ReadsNumericDatasetsOfAnyTypeAndGroup) {
  {
    Hdf5File file("arm.csv");  // chosen by content: the name says csv
    file.doubles("t", {4}, {0, 0.001, 0.002, 0.003});
    file.group("joint");
    std::vector<int> const counts{1, -2, 3, 4};
    file.dataset("joint/q", {4}, H5T_STD_I16BE, H5T_NATIVE_INT, counts.data());
    std::vector<float> const floats{0.5f, 1.5f, 2.5f, 3.5f};
    file.dataset("joint/tau", {4}, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, floats.data());
    file.doubles("table", {4, 2}, {1, 10, 2, 20, 3, 30, 4, 40});
    file.doubles("named", {4, 2}, {5, 50, 6, 60, 7, 70, 8, 80});
    file.text_attribute("named", "columns", {"u", "i_A"}, 0);
    file.doubles("fixed", {4, 2}, {5, 50, 6, 60, 7, 70, 8, 80});
    file.text_attribute("fixed", "columns", {"alpha", "b"}, 5);
  }
  auto const path = data_test::folder() / "arm.csv";
  auto const table = read_table(path, recording_section());
  EXPECT_EQ(table.columns[column_of(table, "t")], (std::vector<double>{0, 0.001, 0.002, 0.003}));
  EXPECT_EQ(table.columns[column_of(table, "joint/q")], (std::vector<double>{1, -2, 3, 4}));
  EXPECT_EQ(table.columns[column_of(table, "joint/tau")], (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
  EXPECT_EQ(table.columns[column_of(table, "table[1]")], (std::vector<double>{10, 20, 30, 40}));
  EXPECT_EQ(table.columns[column_of(table, "i_A")], (std::vector<double>{50, 60, 70, 80}));
  EXPECT_EQ(table.columns[column_of(table, "alpha")], (std::vector<double>{5, 6, 7, 8}));
  EXPECT_TRUE(table.line_of_row.empty());
  EXPECT_EQ(table.sha256, sha256_hex(read_whole_file(path)));
}

// a file as a killed writer leaves it: saved, and marked as open
std::string left_open(std::string const& name, unsigned mode) {
  auto const path = data_test::folder() / name;
  hid_t const access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  hid_t const file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC | mode, H5P_DEFAULT, access);
  hsize_t const rows = 6, open_end = H5S_UNLIMITED, chunk = 3;
  hid_t const space = H5Screate_simple(1, &rows, &open_end), creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 1, &chunk);
  for (char const* signal : {"t", "q"}) {
    hid_t const id = H5Dcreate2(file, signal, H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, ramp(6).data());
    H5Dclose(id);
  }
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  auto const bytes = read_whole_file(path);
  H5Pclose(creation);
  H5Sclose(space);
  H5Pclose(access);
  H5Fclose(file);
  return bytes;
}

TEST(Hdf5Reader, ReadsWhatAKilledWriterSaved) {
  for (unsigned const mode : {0U, H5F_ACC_SWMR_WRITE}) {
    auto const bytes = left_open("open.h5", mode);
    ASSERT_NE(bytes[11], 0);
    auto const table = read_table(data_test::write("left.h5", bytes), recording_section());
    EXPECT_EQ(table.columns[column_of(table, "q")], ramp(6));
    EXPECT_EQ(table.sha256, sha256_hex(bytes));  // of the file as it is
    ASSERT_EQ(table.remarks.size(), 1u);
    EXPECT_NE(table.remarks[0].find("is marked as open"), std::string::npos);
    auto const part = problem_of(
        [&] { read_table(data_test::write("part.h5", bytes.substr(0, bytes.size() / 2)), recording_section()); });
    EXPECT_NE(part.what.find("was left open by the program that wrote it"), std::string::npos);
  }
}

TEST(OpenFlags, AreClearedOnlyInAWholeSuperblock) {
  auto const bytes = left_open("open.h5", 0);
  auto cleared = bytes;
  EXPECT_TRUE(clear_open_flags(cleared));
  EXPECT_EQ(cleared[11], 0);
  EXPECT_EQ(cleared.substr(48), bytes.substr(48));
  EXPECT_FALSE(clear_open_flags(cleared));
  auto damaged = bytes;
  damaged[20] = static_cast<char>(damaged[20] ^ 1);
  EXPECT_FALSE(clear_open_flags(damaged));
  std::string none;
  EXPECT_FALSE(clear_open_flags(none));
}

TEST(Hdf5Reader, FieldsOfStructuresAreColumns) {
  struct Row {
    double t;
    float q[2];
    char const* text;
  };
  {
    Hdf5File file("rows.h5");
    hsize_t const two = 2;
    hid_t const pair = H5Tarray_create2(H5T_NATIVE_FLOAT, 1, &two), text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, H5T_VARIABLE);
    hid_t const type = H5Tcreate(H5T_COMPOUND, sizeof(Row));
    H5Tinsert(type, "t", HOFFSET(Row, t), H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "q", HOFFSET(Row, q), pair);
    H5Tinsert(type, "text", HOFFSET(Row, text), text);
    std::vector<Row> const rows{{0.5, {1, 2}, "a"}, {1.5, {3, 4}, "b"}};
    file.dataset("log", {2}, type, type, rows.data());
    H5Tclose(type);
    H5Tclose(text);
    H5Tclose(pair);
  }
  auto const table = read_table(data_test::folder() / "rows.h5", recording_section());
  EXPECT_EQ(table.columns[column_of(table, "log/t")], (std::vector<double>{0.5, 1.5}));
  EXPECT_EQ(table.columns[column_of(table, "log/q[1]")], (std::vector<double>{2, 4}));
  EXPECT_EQ(reason_of(table, "log/text"), "is not made of plain real numbers");
}

TEST(Hdf5Reader, FieldsOfAPandasTableHaveTheNamesInItsPickle) {
  struct Row {
    double index, values[2], numbered[2];
  };
  std::string const pickle = "(lp0\nVq_rad\np1\naV\\u03c4/Nm\np2\na.";
  {
    Hdf5File file("pandas.h5");
    file.group("df");
    hsize_t const two = 2;
    hid_t const pair = H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &two);
    hid_t const type = H5Tcreate(H5T_COMPOUND, sizeof(Row));
    H5Tinsert(type, "index", HOFFSET(Row, index), H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "values_block_0", HOFFSET(Row, values), pair);
    H5Tinsert(type, "values_block_1", HOFFSET(Row, numbered), pair);
    std::vector<Row> const rows{{0, {1, 2}, {3, 4}}, {1, {5, 6}, {7, 8}}};
    file.dataset("df/table", {2}, type, type, rows.data());
    file.text_attribute("df/table", "values_block_0_kind", {pickle.c_str()}, pickle.size());
    file.text_attribute("df/table", "values_block_1_kind", {"cos\nsystem\n(S'true'\ntR."}, 40);
    H5Tclose(type);
    H5Tclose(pair);
  }
  auto const table = read_table(data_test::folder() / "pandas.h5", recording_section());
  EXPECT_EQ(table.columns[column_of(table, "df/table/q_rad")], (std::vector<double>{1, 5}));
  EXPECT_EQ(table.columns[column_of(table, "df/table/\xcf\x84/Nm")], (std::vector<double>{2, 6}));
  EXPECT_EQ(table.columns[column_of(table, "df/table/values_block_1[1]")], (std::vector<double>{4, 8}));
  ASSERT_EQ(table.remarks.size(), 1u);
  EXPECT_NE(table.remarks[0].find("names of columns cannot be read: they are numbered"), std::string::npos);
}

TEST(PandasNames, AreReadFromListsOfTextsAndNumbersOnly) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names_in_pickle("(lp0\nVt_s\np1\naVq\np2\na."), (Names{"t_s", "q"}));
  EXPECT_EQ(names_in_pickle("(lp0\nI0\naI1\na."), (Names{"0", "1"}));
  EXPECT_EQ(names_in_pickle("(lV\xb0\na."), (Names{"\xc2\xb0"})) << "ISO 8859-1";
  EXPECT_EQ(names_in_pickle("(lV\\U0001f916\na."), (Names{"\xf0\x9f\xa4\x96"}));
  for (std::string_view const other :
       {"", ".", "(lp0\n.", "(lp0\nVt_s\np1\na", "(lp0\nVt_s\np1\na(lp2\n.", "(lp0\nVt_s", "(dp0\n.", "N.",
        "(lV\\u12\na.", "(lV\\uzzzz\na.", "(lV\\u+123\na.", "cos\nsystem\n(S'true'\ntR.", "\x80\x04]\x94."})
    EXPECT_EQ(names_in_pickle(other), Names()) << other;
}

TEST(Hdf5Reader, Matlab73IsTransposedBehindItsUserBlock) {
  {
    Hdf5File file("new.mat", 512);
    file.doubles("t", {1, 5}, ramp(5));  // a MATLAB column
    file.text_attribute("t", "MATLAB_class", {"double"}, 6);
    file.doubles("x", {2, 5}, ramp(10));  // a MATLAB 5 x 2 matrix
    file.text_attribute("x", "MATLAB_class", {"double"}, 6);
    std::vector<std::uint16_t> const letters(5, 65);
    file.dataset("remark", {1, 5}, H5T_STD_U16LE, H5T_NATIVE_USHORT, letters.data());
    file.text_attribute("remark", "MATLAB_class", {"char"}, 4);
  }
  auto const path = data_test::folder() / "new.mat";
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << "MATLAB 7.3 MAT-file, Platform: GLNXA64";
  auto const table = read_table(path, recording_section());
  EXPECT_EQ(table.columns[column_of(table, "t")], ramp(5));
  EXPECT_EQ(table.columns[column_of(table, "x[0]")], ramp(5));
  EXPECT_EQ(table.columns[column_of(table, "x[1]")], ramp(5, 5));
  EXPECT_EQ(reason_of(table, "remark"), "is text");
}

TEST(Hdf5Reader, NumbersOutsideTheFileAreNeverFollowed) {
  {
    Hdf5File other("secret.h5");
    other.doubles("q", {4}, ramp(4));
  }
  auto const raw = data_test::write("secret.raw", std::string(32, 'x'));
  Hdf5File* file = new Hdf5File("links.h5");
  file->doubles("t", {4}, ramp(4));
  file->doubles("u", {4}, ramp(4));
  H5Lcreate_external((data_test::folder() / "secret.h5").c_str(), "/q", file->id(), "away", H5P_DEFAULT, H5P_DEFAULT);
  H5Lcreate_soft("/away", file->id(), "soft", H5P_DEFAULT, H5P_DEFAULT);
  hid_t const external = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_external(external, raw.c_str(), 0, 32);
  file->dataset("external", {4}, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, nullptr, external);
  H5Pclose(external);
  hid_t const views = H5Pcreate(H5P_DATASET_CREATE);
  hsize_t const size = 4;
  hid_t const space = H5Screate_simple(1, &size, nullptr);
  H5Pset_virtual(views, space, (data_test::folder() / "secret.h5").c_str(), "q", space);
  file->dataset("virtual", {4}, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, nullptr, views);
  H5Sclose(space);
  H5Pclose(views);
  auto const path = file->path();
  delete file;

  auto const table = read_table(path, recording_section());
  EXPECT_EQ(table.names, (std::vector<std::string>{"t", "u"}));
  EXPECT_EQ(reason_of(table, "away"), "is a link into another file; copy its numbers into this one");
  EXPECT_EQ(reason_of(table, "soft"), "is a soft link; name the path it points to");
  EXPECT_EQ(reason_of(table, "external"), "keeps its numbers in another file; copy them into this one");
  EXPECT_EQ(reason_of(table, "virtual"), "is a virtual dataset over other files; copy its numbers into this one");
}

TEST(Hdf5Reader, SaysWhyADatasetCannotServe) {
  {
    Hdf5File file("mixed.h5");
    file.doubles("t", {20}, ramp(20));
    file.doubles("q", {20}, ramp(20));
    file.doubles("rate", {1}, {1000});
    file.doubles("cube", {2, 2, 2}, ramp(8));
    file.doubles("nothing", {0}, {});
    hid_t const complex = H5Tcreate(H5T_COMPOUND, 16);
    H5Tinsert(complex, "r", 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(complex, "i", 8, H5T_NATIVE_DOUBLE);
    file.dataset("complex", {4}, complex, complex, nullptr);
    H5Tclose(complex);
    H5Lcreate_hard(file.id(), "/", file.id(), "itself", H5P_DEFAULT, H5P_DEFAULT);  // a group within itself
  }
  auto const table = read_table(data_test::folder() / "mixed.h5", recording_section());
  EXPECT_EQ(table.names.size(), 2u);
  EXPECT_EQ(reason_of(table, "rate"), "has 1 values where the signals have 20");
  EXPECT_EQ(reason_of(table, "cube"), "has rank 3 (a signal has 1, a table of signals 2)");
  EXPECT_EQ(reason_of(table, "nothing"), "is empty");
  EXPECT_EQ(reason_of(table, "complex"), "is not made of plain real numbers");
}

TEST(Hdf5Reader, SizesAreCheckedBeforeAnythingIsAllocated) {
  {
    Hdf5File file("bomb.h5");
    hid_t const chunked = H5Pcreate(H5P_DATASET_CREATE);  // never written: 8 TiB of fill values in 2 kB
    hsize_t const chunk[] = {1024, 1};
    H5Pset_chunk(chunked, 2, chunk);
    file.dataset("q", {std::uint64_t{1} << 36, 16}, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, nullptr, chunked);
    H5Pclose(chunked);
  }
  auto const problem = problem_of([&] { read_table(data_test::folder() / "bomb.h5", recording_section()); });
  EXPECT_EQ(problem.code, ExitCode::bad_data);
  EXPECT_TRUE(problem.what.ends_with("holds no columns of numbers"));
  EXPECT_EQ(problem.notes,
            std::vector<std::string>{"\"q\" claims 68719476736 x 16 numbers, far more than its bytes can hold"});
}

TEST(Hdf5Reader, StumpsAndEmptyFilesAreRefused) {
  {
    Hdf5File file("good.h5");
    file.doubles("t", {2000}, ramp(2000));
  }
  auto const bytes = read_whole_file(data_test::folder() / "good.h5");
  auto const stump = data_test::write("stump.h5", bytes.substr(0, bytes.size() / 2));
  auto const problem = problem_of([&] { read_table(stump, recording_section()); });
  EXPECT_EQ(problem.code, ExitCode::bad_data);
  EXPECT_TRUE(problem.what.ends_with("is a damaged HDF5 file, or was cut short"));
  { Hdf5File const file("void.h5"); }
  EXPECT_TRUE(problem_of([&] {
                read_table(data_test::folder() / "void.h5", recording_section());
              }).what.ends_with("holds no columns of numbers"));
}

}  // namespace hdf5_test
}  // namespace torquescope
