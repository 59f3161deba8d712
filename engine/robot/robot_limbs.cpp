#include "engine/robot/robot_limbs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace torquescope {

namespace {

constexpr std::size_t most_ends_shown = 12;

// a path from the root with joints that move, none of which floats
struct Limb {
  std::vector<std::string> path{}, joints{};
  std::string floats{};  // child of the first floating joint behind the root
};

Limb limb_to(RobotTree const& tree, std::string const& link, std::string const& root) {
  Limb limb;
  limb.path = path_to(tree, link);
  auto const begin = std::find(limb.path.begin(), limb.path.end(), root);
  std::vector<std::string> const behind(begin == limb.path.end() ? limb.path.begin() : begin + 1, limb.path.end());
  limb.joints = moving_joints(tree, behind);
  for (auto const& one : behind)
    if (limb.floats.empty() && tree.joint_to.at(one).motion == JointMotion::floats) limb.floats = one;
  return limb;
}

// every link at or behind the root
std::vector<Limb> limbs_behind(RobotTree const& tree, std::string const& root) {
  std::vector<Limb> limbs;
  for (auto const& [child, joint] : tree.joint_to) {
    auto const path = path_to(tree, child);
    if (root != tree.root && std::find(path.begin(), path.end(), root) == path.end()) continue;
    limbs.push_back(limb_to(tree, child, root));
  }
  return limbs;
}

bool is_longer(Limb const& one, Limb const& other) {
  return std::pair(one.joints.size(), one.path.size()) > std::pair(other.joints.size(), other.path.size());
}

bool goes_on(Limb const& one, Limb const& other) {
  return other.joints.size() >= one.joints.size() &&
         std::equal(one.joints.begin(), one.joints.end(), other.joints.begin());
}

// of every way the longest limb: its end is a tip that one may write
std::vector<Limb> ends_of(std::vector<Limb> const& limbs) {
  std::vector<Limb> ends;
  for (auto const& limb : limbs) {
    if (limb.joints.empty()) continue;
    auto const same = std::find_if(ends.begin(), ends.end(),
                                   [&](Limb const& end) { return goes_on(limb, end) || goes_on(end, limb); });
    if (same == ends.end())
      ends.push_back(limb);
    else if (is_longer(limb, *same))
      *same = limb;
  }
  return ends;
}

std::vector<std::string> end_lines(std::vector<Limb> const& ends) {
  std::vector<std::string> lines;
  for (auto const& end : ends) {
    if (lines.size() == most_ends_shown) {
      lines.push_back(fmt::format("and {} more", ends.size() - lines.size()));
      break;
    }
    lines.push_back(fmt::format("tip = \"{}\": {}", end.path.back(), fmt::join(end.joints, ", ")));
  }
  return lines;
}

[[noreturn]] void refuse_floating(std::string const& file, RobotTree const& tree, std::vector<Limb> const& limbs) {
  auto const first = std::find_if(limbs.begin(), limbs.end(),
                                  [](Limb const& one) { return !one.floats.empty() && !one.joints.empty(); });
  auto const& joint = tree.joint_to.at(first->floats);
  std::vector<Limb> within;
  for (auto const& limb : limbs)
    if (limb.floats == first->floats) within.push_back(limb_to(tree, limb.path.back(), first->floats));
  auto const ends = ends_of(within);
  std::string const tip = ends.size() > 1 ? fmt::format(" and tip = \"{}\"", ends.front().path.back()) : "";
  Problem problem;
  problem.what = fmt::format("\"{}\" of {} floats, and an arm stands on something that does not", first->floats, file);
  problem.place = joint.place;
  if (ends.size() > 1) problem.notes = end_lines(ends);
  problem.help = fmt::format(
      "hold it while you record, and write root = \"{}\"{} beside the robot file ([model], or [robot] beside urdf; "
      "describe and init take --root and --tip)",
      first->floats, tip);
  throw Error(std::move(problem));
}

[[noreturn]] void refuse_branches(std::string const& file, RobotTree const& tree, std::vector<Limb> const& ends,
                                  Limb const& best) {
  Problem problem;
  for (auto const& end : ends)
    for (auto const& link : end.path)
      if (auto const& joint = tree.joint_to.at(link);
          problem.place.file.empty() && joint.moves_itself() &&
          std::find(best.joints.begin(), best.joints.end(), joint.joint.name) == best.joints.end())
        problem.place = joint.place;
  problem.what = fmt::format("{} has branches: it ends in {} places, and not every joint is on the way to \"{}\"", file,
                             ends.size(), best.path.back());
  problem.notes = end_lines(ends);
  problem.help = fmt::format(
      "write where the arm ends, for example tip = \"{}\", beside the robot file ([model], or [robot] beside urdf; "
      "describe --tip)",
      ends.front().path.back());
  throw Error(std::move(problem));
}

}  // namespace

std::vector<std::string> path_to(RobotTree const& tree, std::string link) {
  std::vector<std::string> path;
  for (; link != tree.root; link = tree.joint_to.at(link).parent) path.push_back(link);
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<std::string> moving_joints(RobotTree const& tree, std::vector<std::string> const& path) {
  std::vector<std::string> joints;
  for (auto const& link : path)
    if (tree.joint_to.at(link).moves_itself()) joints.push_back(tree.joint_to.at(link).joint.name);
  return joints;
}

std::string only_tip(std::string const& file, RobotTree const& tree, std::string const& root) {
  auto const limbs = limbs_behind(tree, root);
  std::vector<Limb> standing;
  bool is_any_floating = false;
  for (auto const& limb : limbs) {
    if (limb.floats.empty())
      standing.push_back(limb);
    else
      is_any_floating = is_any_floating || !limb.joints.empty();
  }
  // a joint that floats within an arm: the arm's maker refuses it there
  for (auto const& limb : limbs)
    if (!limb.floats.empty() && moving_joints(tree, path_to(tree, limb.floats)).size() < limb.joints.size() &&
        !moving_joints(tree, path_to(tree, limb.floats)).empty())
      return limb.path.back();
  auto const ends = ends_of(standing);
  if (ends.empty() && is_any_floating) refuse_floating(file, tree, limbs);
  if (ends.empty()) {
    Problem problem;
    problem.what = root == tree.root ? fmt::format("no joint of {} moves", file)
                                     : fmt::format("no joint behind \"{}\" moves", root);
    problem.place.file = file;
    problem.help = "an arm has revolute or prismatic joints";
    throw Error(std::move(problem));
  }
  auto const best = *std::min_element(ends.begin(), ends.end(), is_longer);
  if (ends.size() > 1) refuse_branches(file, tree, ends, best);
  return best.path.back();
}

}  // namespace torquescope
