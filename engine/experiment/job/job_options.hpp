#pragma once
// The two sections that belong to no layer of mathematics: [experiment] and [output].

#include <cstdint>
#include <string>

#include "engine/base/options.hpp"

namespace torquescope {

struct ExperimentOptions {
  std::string name{};   // default: the job file's stem
  std::string study{};  // a study the page knows: "crs_a465" puts the paper's tables beside ours
  std::int64_t seed = 1;
  std::int64_t runs = 30;  // independent runs of every population method

  static OptionTable<ExperimentOptions> const& table();
};

struct OutputOptions {
  std::string file{};                // default: NAME.h5 in the working folder
  std::string compression = "none";  // "none" or "gzip"
  bool samples = true;               // false: no sample of a recording, which a page would draw
  bool populations = true;           // false: of every generation its best alone
  std::string history = "full";      // generations that are stored: StoredGenerations

  static OptionTable<OutputOptions> const& table();
};

}  // namespace torquescope
