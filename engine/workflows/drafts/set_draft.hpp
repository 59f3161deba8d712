#pragma once
// [[recordings]] sections that take exactly the files of a list, by the parts of their names.
//
// Exact      one pattern a folder where it matches no other file and gives back each number; else one for each value of
//            a quantity; else one for each file, to twelve; else a pattern that takes more, and how many more
// Judged     about a fifth of the files, whole values of one quantity: an inner mass, length or other number, else a
//            word; or a folder whose name says "validate", "test" or "unseen"
// Threads    free function

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/workflows/drafts/name_parts.hpp"

namespace torquescope {

// one [[recordings]]
struct DraftedSection {
  std::string files;  // its pattern
  bool is_validation = false;
  std::map<std::string, std::string> fixed{};  // quantities that its pattern has as letters
  std::size_t n_files = 0;                     // of the list
  std::size_t n_more = 0;                      // files it matches beside those of the list
};

struct SetDraft {
  std::vector<DraftedSection> sections{};
  std::vector<NameQuantity> quantities{};                  // that every file has
  std::vector<std::map<std::string, std::string>> values;  // of each file
  std::string judged_by{};                                 // the quantity that tells what judges: "mass_kg"
};

// files: as the job is to write them, relative to `folder` or from the root; each once
SetDraft draft_set(std::vector<std::string> const& files, std::filesystem::path const& folder);

}  // namespace torquescope
