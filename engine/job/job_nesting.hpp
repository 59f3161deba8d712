#pragma once
// Bounds the nesting of a job text before the TOML parser, which recurses, sees it.
//
// Counts     open brackets and braces, and the dots of one key: a.b.c = 1 and [a.b.c] nest as deep as {a = {b = {c =
// 1}}} Requires   nothing: any bytes; inside texts and comments nothing counts

#include <optional>
#include <string_view>

namespace torquescope {

// offset of the byte where the nesting first exceeds `deepest`, or nothing
std::optional<std::size_t> first_too_deep(std::string_view text, int deepest);

}  // namespace torquescope
