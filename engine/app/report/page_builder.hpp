#pragma once
// Builds HTML pages with the Python programs scripts/report/build.py (one result) and compare.py (several).
//
// Finds      the program in $TORQUESCOPE_SHARE, beside the executable (../share/torquescope), or in the source tree
//            above it; Python as /usr/bin/python3, then as python3 in PATH, the first that has the packages
// Errors     Error 66 (program not found), 70 (Python or a package is missing, or the program failed)

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace torquescope {

void build_page(std::filesystem::path const& result, std::filesystem::path const& page);

// the results side by side, in this order
void build_comparison(std::span<std::string const> results, std::filesystem::path const& page);

// the first of the folders that holds scripts/report/NAME or report/NAME, searched in this order
std::optional<std::filesystem::path> find_page_program(std::string const& share_variable,
                                                       std::filesystem::path const& executable,
                                                       std::string const& name = "build.py");

}  // namespace torquescope
