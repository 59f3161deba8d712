#pragma once
// TOML text to sections with places; the only file that knows the TOML library is toml_sections.cpp.
//
// Errors     Error 78 with every place; a syntax error ends the reading, other problems are collected
// Threads    function of its arguments

#include <optional>
#include <string>
#include <vector>

#include "engine/base/options.hpp"

namespace torquescope {

// what a kind of file may hold, and the words for it
struct TomlDialect {
  std::string noun{};                   // "job"
  std::vector<std::string> repeated{};  // sections that may be written [[name]] several times
  std::vector<std::string> map_keys{};  // keys whose value is a table of texts, and not a section
  std::string section_example{};        // "a section is written [filter], an estimator [[estimator]]"
  std::string where_to_read{};          // ends a help: "      (torquescope describe experiment)"
  // what a text that is no TOML is instead, if anything
  std::optional<Problem> (*not_one)(std::string const& text, std::string const& file) = nullptr;
};

std::vector<Section> toml_sections(std::string const& text, std::string const& file, TomlDialect const& dialect);

}  // namespace torquescope
