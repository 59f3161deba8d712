#pragma once
// Spellings of one name made alike: full-width brackets as ASCII ones, Latin letters without their accents.
//
// Text       UTF-8; "（N·m）" -> "(N·m)"; "Vitesse mesurée" -> "Vitesse mesuree", "Stößel" -> "Stossel"
// Threads    functions of their arguments

#include <string>
#include <string_view>

namespace torquescope {

std::string with_plain_brackets(std::string_view name);
std::string without_accents(std::string_view word);  // in lower case where a letter had one

}  // namespace torquescope
