#pragma once
// Files, job sections and caught problems for the tests of engine/data.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "engine/base/error.hpp"
#include "engine/data/recording_reader.hpp"

namespace torquescope::data_test {

// a folder of its own per test process, gone at its end
class TempFolder {
 public:
  TempFolder() : path_(std::filesystem::temp_directory_path() / ("torquescope_data_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(TempFolder const&) = delete;
  TempFolder& operator=(TempFolder const&) = delete;
  std::filesystem::path operator/(std::string const& name) const { return path_ / name; }
  std::filesystem::path const& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline TempFolder const& folder() {
  static TempFolder const one;
  return one;
}

inline std::filesystem::path write(std::string const& name, std::string const& bytes) {
  auto const path = folder() / name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

// the job's [recording] with a place for every key
inline Section recording_section() {
  Section section;
  section.name = "recording";
  section.place = {"job.toml", 5, 1, 11, "[recording]"};
  auto const add = [&](char const* key, OptionValue value, int line) {
    section.settings.push_back({key, std::move(value), {"job.toml", line, 1, 5, ""}, {"job.toml", line, 12, 5, ""}});
  };
  add("train", std::vector<std::string>{"arm.csv"}, 6);
  add("columns", std::map<std::string, std::string>{}, 8);
  add("delay_s", -0.004, 9);
  return section;
}

// the problems of the Error that `act` throws
template <class Act>
std::vector<Problem> problems_of(Act&& act) {
  try {
    act();
  } catch (Error const& error) {
    return error.problems();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {Problem{}};
}

template <class Act>
Problem problem_of(Act&& act) {
  return problems_of(act).front();
}

}  // namespace torquescope::data_test
