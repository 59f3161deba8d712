#pragma once
// Files, job sections and caught problems for the tests of engine/data.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "engine/base/error.hpp"
#include "engine/data/recording_reader.hpp"
#include "support/temporary_folder.hpp"

namespace torquescope::data_test {

// one per test process
inline test::TemporaryFolder const& folder() {
  static test::TemporaryFolder const one;
  return one;
}

inline std::filesystem::path write(std::string const& name, std::string const& bytes) {
  return folder().write(name, bytes);
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
