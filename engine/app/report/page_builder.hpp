#pragma once
// Builds the HTML page with the Python program scripts/report/build.py.
//
// Finds      the program in $TORQUESCOPE_SHARE, beside the executable (../share/torquescope), or in the source tree
// above
//            it; Python as /usr/bin/python3, then as python3 in PATH, the first that has the packages
// Errors     Error 66 (program not found), 70 (Python or a package is missing, or the program failed)

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace torquescope {

void build_page(std::filesystem::path const& result, std::filesystem::path const& page);

// the first of the folders that holds scripts/report/build.py or report/build.py, searched in this order
std::optional<std::filesystem::path> find_page_program(std::string const& share_variable,
                                                       std::filesystem::path const& executable);

}  // namespace torquescope
