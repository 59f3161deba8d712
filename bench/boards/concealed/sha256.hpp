#pragma once
// SHA-256 of a text, in 64 hexadecimal digits.

#include <string>

namespace concealed {

std::string sha256(std::string const& text);

}  // namespace concealed
