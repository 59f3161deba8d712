#pragma once
// Man pages in section 1, as roff: one of the program, one of each command.
//
// Texts      made of the pages and of exit_codes(); no date, so that equal programs have equal pages

#include <string>
#include <vector>

#include "engine/app/shell/command_page.hpp"

namespace torquescope {

std::string program_man_page(std::vector<CommandPage> const& pages);
std::string command_man_page(CommandPage const& page);
std::string man_page_file(std::string const& command);  // "torquescope-run.1"; of "": "torquescope.1"

}  // namespace torquescope
