#pragma once
// A table of recordings: CSV with a header; column `file`, perhaps `role`, every other column a quantity.
//
// Columns    all numbers, or all text; an empty cell ("", NA) says that the quantity of this recording is not known
// Order      rows as they stand in the file
// Errors     problems are appended, each with file, line and column: 66 no such file; 65 no rows, no column `file`, a
//            column that is there twice, a row of another length, text among numbers, a role that is none
// Threads    function of its arguments and of the file

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace torquescope {

struct ManifestRow {
  std::string file;  // as written: relative to the manifest
  std::string role;  // "train", "validate", or "": the table does not say
  SourcePlace place{};
  std::map<std::string, double> numbers{};
  std::map<std::string, std::string> words{};
};

struct RecordingManifest {
  std::vector<std::string> quantities{};  // columns beside `file` and `role`
  SourcePlace header{};
  std::vector<ManifestRow> rows{};
};

RecordingManifest read_manifest(std::filesystem::path const& path, std::vector<Problem>& problems);

}  // namespace torquescope
