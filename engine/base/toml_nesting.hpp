#pragma once
// Bounds the nesting of a TOML text before the parser, which recurses, sees it.
//
// Counts     open brackets and braces, and the dots of one key: a.b.c = 1 and [a.b.c] nest as deep as
//            {a = {b = {c = 1}}}; inside texts and comments nothing counts
// Requires   nothing: any bytes

#include <optional>
#include <string_view>

namespace torquescope {

// offset of the byte where the nesting first exceeds `deepest`, or nothing
std::optional<std::size_t> first_too_deep(std::string_view text, int deepest);

}  // namespace torquescope
