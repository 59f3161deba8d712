#pragma once
// What the process was started in: variables, terminals, letters. Read once, handed on as facts, so that rules are
// testable.

#include <string>

namespace torquescope {

std::string environment(char const* name);  // "" when unset

bool is_terminal(int descriptor);
// columns of the terminal behind `descriptor`, at most widest_page, measured now (windows are resized); 80 when unknown
int terminal_width(int descriptor);
// whether bars and marks may leave ASCII: the locale's codeset is UTF-8
bool locale_is_utf8();

}  // namespace torquescope
