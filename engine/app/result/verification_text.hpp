#pragma once
// What `show --verify` says about a file that is whole: what was checked, and what no stored digest covers.

#include <string>

#include "engine/store/verification.hpp"

namespace torquescope {

std::string verification_text(Verification const& facts);  // begins with "verified"
// {"schema": 1, "file", "bytes", "verified": true, "content": {...}, "job": {...}, "provenance": {...}}
std::string verification_json(Verification const& facts);

}  // namespace torquescope
