#pragma once
// A section of an arm's job as each of its joints reads it: a list of numbers where a joint alone has one number holds
// one for each joint.
//
// Example    viscous = [2.0, 3.0, 1.5] of three joints; viscous = 2.0 of all of them
// Errors     Problems with exit code 78: a list of another length
// Threads    free functions

#include <functional>
#include <string>
#include <vector>

#include "engine/base/options.hpp"

namespace torquescope {

// one a joint. takes_list: keys whose value is a list for a single joint as well
std::vector<Section> sections_of_joints(Section const& section, std::size_t joints,
                                        std::function<bool(std::string const& key)> const& takes_list,
                                        std::vector<Problem>& problems);

// keys of a table that take a list of numbers
std::function<bool(std::string const&)> list_keys(std::vector<OptionDescription> const& options);

// what several joints complain of alike stands once
void append_new(std::vector<Problem> const& found, std::vector<Problem>& problems);

}  // namespace torquescope
