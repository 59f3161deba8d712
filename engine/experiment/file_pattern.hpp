#pragma once
// Files whose names match a pattern: "train/servo_m{mass_kg}_{motion}.csv.gz", "logs/*.csv", "run_??.csv".
//
// {name}     matches one letter or more, as few as possible, never '/'; what it matched is kept under the name
// * ?        any letters, none included; one letter; never '/'
// Hidden     a name that begins with a dot is matched only where the pattern writes the dot
// Order      matches are sorted by name, byte by byte
// Errors     none; a folder that cannot be read has no files
// Threads    functions of their arguments and of the folder

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace torquescope {

struct PatternMatch {
  std::string file;                          // as the pattern writes it: relative to the folder, or from the root
  std::map<std::string, std::string> texts;  // what each {name} matched
};

// what is wrong with the pattern itself, as a sentence; "": nothing
std::string fault_of_pattern(std::string const& pattern);
std::vector<std::string> names_in_pattern(std::string const& pattern);

// what each {name} of a pattern without '/' matches in a name; nothing where the whole does not match
std::optional<std::map<std::string, std::string>> match_name(std::string const& pattern, std::string const& name);

// regular files alone; Requires  a pattern without fault
std::vector<PatternMatch> files_matching(std::filesystem::path const& folder, std::string const& pattern);

// for the message where nothing matched: what is there instead
std::vector<std::string> what_is_there(std::filesystem::path const& folder, std::string const& pattern);

}  // namespace torquescope
