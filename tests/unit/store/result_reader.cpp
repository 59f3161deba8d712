#include "engine/store/result_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/stat.h>

#include <functional>

#include "engine/base/error.hpp"
#include "support/temporary_folder.hpp"
#include "unit/store/example_result.hpp"

namespace torquescope {
namespace result_reader_test {

using testing::HasSubstr;

// the exit code and the words of what went wrong
std::pair<ExitCode, std::string> outcome(std::function<void()> const& action) {
  try {
    action();
  } catch (Error const& error) {
    return {error.code(), error.what()};
  }
  return {ExitCode::ok, ""};
}

std::pair<ExitCode, std::string> opening(std::filesystem::path const& name) {
  return outcome([&] { ResultReader const reader(name); });
}

std::pair<ExitCode, std::string> verifying(std::filesystem::path const& name) {
  return outcome([&] { verify_result(name); });
}

TEST(ResultReader, TellsWhatKindOfFileItCannotRead) {
  test::TemporaryFolder const folder;
  EXPECT_EQ(opening(folder / "R.h5").first, ExitCode::no_input);
  EXPECT_THAT(opening(folder / "R.h5").second, HasSubstr("there is no file"));

  test::write_bytes(folder / "text", "t_s,q_rad\n0,0\n");
  EXPECT_EQ(opening(folder / "text").first, ExitCode::bad_data);
  EXPECT_THAT(opening(folder / "text").second, HasSubstr("is not an HDF5 file"));
  EXPECT_EQ(opening(folder.path()).first, ExitCode::bad_data);

  // a pipe without a writer would hang whoever opens it
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(opening(folder / "pipe").first, ExitCode::bad_data);

  H5Fclose(H5Fcreate((folder / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_EQ(opening(folder / "other.h5").first, ExitCode::bad_data);
  EXPECT_THAT(opening(folder / "other.h5").second, HasSubstr("not a result of torquescope"));
}

// changes a finished file with HDF5 itself, as somebody else's program could
void tamper(std::filesystem::path const& name, std::function<void(hid_t)> const& change) {
  hid_t const file = H5Fopen(name.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  change(file);
  H5Fclose(file);
}

void set_root_number(hid_t file, char const* name, std::int64_t value) {
  hid_t const attribute = H5Aopen(file, name, H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_INT64, &value);
  H5Aclose(attribute);
}

TEST(ResultReader, RefusesANewerFormatAndAnUnfinishedFile) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5");
  tamper(folder / "R.h5", [](hid_t file) { set_root_number(file, "complete", 0); });
  EXPECT_THAT(opening(folder / "R.h5").second, HasSubstr("was never finished"));
  tamper(folder / "R.h5", [](hid_t file) { set_root_number(file, "format", result_format + 1); });
  EXPECT_EQ(opening(folder / "R.h5").first, ExitCode::bad_data);
  EXPECT_THAT(opening(folder / "R.h5").second, HasSubstr("has format 4; this version reads up to 3"));
}

TEST(ResultReader, DoesNotCallAnOlderFormatDamaged) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5");
  tamper(folder / "R.h5", [](hid_t file) { set_root_number(file, "format", 1); });
  ResultReader const reader(folder / "R.h5");
  EXPECT_EQ(reader.numbers("/data/train/torque").values, example::torque());
  try {
    reader.verify();
    ADD_FAILURE() << "the digest of format 1 is another one";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_THAT(error.what(), HasSubstr("has format 1: its digest was taken in another way"));
  }
}

TEST(ResultReader, FollowsNoLinkToElsewhere) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "other.h5");
  for (bool external : {false, true}) {
    example::write_result(folder / "R.h5");
    tamper(folder / "R.h5", [&](hid_t file) {
      if (external)
        H5Lcreate_external((folder / "other.h5").c_str(), "/job", file, "stolen", H5P_DEFAULT, H5P_DEFAULT);
      else
        H5Lcreate_soft("/job", file, "stolen", H5P_DEFAULT, H5P_DEFAULT);
    });
    EXPECT_EQ(verifying(folder / "R.h5").first, ExitCode::bad_data);
    ResultReader const reader(folder / "R.h5");
    EXPECT_THAT(outcome([&] { reader.texts("/stolen/text"); }).second, HasSubstr("is a link to elsewhere"));
    EXPECT_THAT(verifying(folder / "R.h5").second, HasSubstr("is a link to elsewhere"));
  }
}

TEST(ResultReader, BelievesNoSizeThatTheFileCannotHold) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5");
  tamper(folder / "R.h5", [](hid_t file) {
    hsize_t const claimed[] = {hsize_t{1} << 40, 8}, chunk[] = {1, 8};
    hid_t const space = H5Screate_simple(2, claimed, nullptr), list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(list, 2, chunk);
    H5Dclose(H5Dcreate2(file, "huge", H5T_IEEE_F64LE, space, H5P_DEFAULT, list, H5P_DEFAULT));
    H5Pclose(list);
    H5Sclose(space);
  });
  ResultReader const reader(folder / "R.h5");
  EXPECT_THAT(outcome([&] { reader.numbers("/huge"); }).second, HasSubstr("claims more values"));
  EXPECT_EQ(verifying(folder / "R.h5").first, ExitCode::bad_data);
  EXPECT_THAT(verifying(folder / "R.h5").second, HasSubstr("/huge: it claims more values than the file can hold"));
}

TEST(ResultReader, RefusesValuesKeptInAnotherFile) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5");
  tamper(folder / "R.h5", [](hid_t file) {
    hsize_t const extent = 4;
    hid_t const space = H5Screate_simple(1, &extent, nullptr), list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(list, "/etc/hostname", 0, 32);
    H5Dclose(H5Dcreate2(file, "outside", H5T_IEEE_F64LE, space, H5P_DEFAULT, list, H5P_DEFAULT));
    H5Pclose(list);
    H5Sclose(space);
  });
  EXPECT_THAT(verifying(folder / "R.h5").second, HasSubstr("lie in another file"));
}

TEST(ResultReader, RefusesTextsOfVariableLength) {
  // HDF5 keeps them without a checksum, and crashes when they are damaged
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5");
  tamper(folder / "R.h5", [](hid_t file) {
    hid_t const type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, H5T_VARIABLE);
    hid_t const attribute = H5Acreate2(file, "variable", type, space, H5P_DEFAULT, H5P_DEFAULT);
    char const* const text = "text";
    H5Awrite(attribute, type, &text);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
  });
  EXPECT_THAT(verifying(folder / "R.h5").second, HasSubstr("\"variable\": it has a type that results never have"));
}

TEST(ResultReader, NoticesAChangeMadeByAnotherProgram) {
  test::TemporaryFolder const folder;
  auto const verifying_after = [&](std::function<void(hid_t)> const& change) {
    example::write_result(folder / "R.h5");
    tamper(folder / "R.h5", change);
    return outcome([&] { verify_result(folder / "R.h5"); }).second;
  };
  double const changed = 0.1;
  EXPECT_THAT(verifying_after([&](hid_t file) {
                hid_t const group = H5Gopen2(file, "/runs/fade", H5P_DEFAULT);
                hid_t const attribute = H5Aopen(group, "cr_start", H5P_DEFAULT);
                EXPECT_GE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &changed), 0);
                H5Aclose(attribute);
                H5Gclose(group);
              }),
              HasSubstr("its content does not match its sha256"));
  EXPECT_THAT(verifying_after([&](hid_t file) {
                hid_t const dataset = H5Dopen2(file, "/runs/fade/mse", H5P_DEFAULT);
                std::vector<double> const values(example::runs, changed);
                EXPECT_GE(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
                H5Dclose(dataset);
              }),
              HasSubstr("its content does not match its sha256"));
  EXPECT_THAT(verifying_after([](hid_t) {}), HasSubstr("its seal is missing")) << "opened for writing";
}

TEST(ResultReader, ListsWhatThereIsAndSaysWhatIsNot) {
  test::TemporaryFolder const folder;
  example::write_result(folder / "R.h5");
  ResultReader const reader(folder / "R.h5");
  EXPECT_EQ(reader.children("/runs"), (std::vector<std::string>{"fade", "ols", "run"}));
  EXPECT_EQ(reader.children("/runs/fade"),
            (std::vector<std::string>{"evaluations", "generation", "member", "mse", "parameter", "population"}));
  EXPECT_TRUE(reader.exists("/runs/fade/mse"));
  EXPECT_FALSE(reader.exists("/runs/fade/mse/deeper"));
  EXPECT_FALSE(reader.exists("/diagnosis/verdict"));
  EXPECT_EQ(reader.attribute_names("/runs/fade"), (std::vector<std::string>{"cr_start", "kind", "parameters_mean"}));
  EXPECT_EQ(reader.find_attribute<double>("/runs/fade", "banana"), std::nullopt);
  EXPECT_EQ(reader.attribute<double>("/job", "seed"), 42.0);

  auto const missing = outcome([&] { reader.numbers("/runs/fade/banana"); });
  EXPECT_EQ(missing.first, ExitCode::bad_data);
  EXPECT_THAT(missing.second, HasSubstr("in /runs/fade/banana: there is no \"banana\""));
  EXPECT_THAT(outcome([&] { reader.numbers("/runs/fade/evaluations"); }).second, HasSubstr("another type"));
  EXPECT_THAT(outcome([&] { reader.attribute<double>("/job", "name"); }).second,
              HasSubstr("in /job: attribute \"name\" is a text, not a number"));
}

}  // namespace result_reader_test
}  // namespace torquescope
