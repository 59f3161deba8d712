#pragma once
// What commands do with a result: the tables of one just made or found, and their JSON; the look before a page.

#include <filesystem>
#include <string>

#include "engine/app/result/result_summary.hpp"
#include "engine/app/session.hpp"

namespace torquescope {

// how run and merge end: the tables, and where the file stands; word: "wrote" or "kept"
ExitCode end_with_results(Session const& session, ResultSummary const& summary, std::string const& word,
                          std::filesystem::path const& file);

// a page stays when its file is gone: all of it is compared before Python is asked; Error 65 when it is damaged
void verify_before_page(std::filesystem::path const& result);

}  // namespace torquescope
