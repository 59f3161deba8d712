#include "engine/workflows/drafts/joint_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/data/column_guess.hpp"

namespace torquescope {

namespace {

[[noreturn]] void refuse(std::filesystem::path const& recording, std::string const& joint,
                         std::vector<std::string> const& names) {
  Problem problem;
  problem.code = ExitCode::usage;
  problem.what = fmt::format("{} has no joint \"{}\"", recording.string(), joint);
  problem.notes.push_back(fmt::format("its joints: {}", fmt::join(names, ", ")));
  auto const similar = closest_name(joint, names);
  problem.help = similar.empty() ? "--joint takes a name, or a number counted from 1 in the order of the file"
                                 : fmt::format("did you mean --joint {}?", similar);
  throw Error(std::move(problem));
}

}  // namespace

std::string joint_name(std::string const& position_column) {
  auto const last = position_column.rfind('/');
  if (last == std::string::npos || last == 0) return position_column;
  std::string const before = position_column.substr(0, last);
  auto const slash = before.rfind('/');
  return slash == std::string::npos ? before : before.substr(slash + 1);
}

std::size_t joint_number(std::filesystem::path const& recording, std::string const& joint) {
  if (joint.empty()) return 0;
  constexpr std::size_t most_digits = 4;
  bool const is_number = joint.size() <= most_digits && joint.find_first_not_of("0123456789") == std::string::npos;
  if (is_number && std::stoul(joint) > 0) return std::stoul(joint);
  auto const guess = guess_columns(read_table(recording, {"recording", {}, {}}));
  std::vector<std::string> names;
  for (auto const& column : guess.positions) names.push_back(joint_name(column));
  for (auto const* said : {static_cast<std::vector<std::string> const*>(&names), &guess.positions})
    if (std::count(said->begin(), said->end(), joint) == 1)
      return static_cast<std::size_t>(std::find(said->begin(), said->end(), joint) - said->begin()) + 1;
  refuse(recording, joint, names);
}

}  // namespace torquescope
