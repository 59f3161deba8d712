#include "engine/robot/urdf_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "engine/robot/axis_frames.hpp"
#include "engine/robot/urdf_tree.hpp"

namespace torquescope {

namespace {

[[noreturn]] void refuse(SourcePlace place, std::string what, std::string help, std::vector<std::string> notes = {}) {
  Problem problem;
  problem.what = std::move(what);
  problem.place = std::move(place);
  problem.notes = std::move(notes);
  problem.help = std::move(help);
  throw Error(std::move(problem));
}

// joints from the root to a link, as child links
std::vector<std::string> path_to(UrdfTree const& tree, std::string link) {
  std::vector<std::string> path;
  for (; link != tree.root; link = tree.joint_to.at(link).parent) path.push_back(link);
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<std::string> movable(UrdfTree const& tree, std::vector<std::string> const& path) {
  std::vector<std::string> joints;
  for (auto const& link : path)
    if (tree.joint_to.at(link).moves_itself()) joints.push_back(tree.joint_to.at(link).joint.name);
  return joints;
}

// the longest path that has every movable joint; a tool's frame is at the end of it
std::string only_tip(RobotText const& text, UrdfTree const& tree) {
  std::set<std::string> all;
  for (auto const& [child, joint] : tree.joint_to)
    if (joint.moves_itself()) all.insert(joint.joint.name);
  std::vector<std::string> best;
  for (auto const& [child, joint] : tree.joint_to) {
    auto const path = path_to(tree, child);
    auto const key = [&](auto const& one) { return std::pair(movable(tree, one).size(), one.size()); };
    if (best.empty() || key(path) > key(best)) best = path;
  }
  if (all.empty()) refuse(text.whole(), "no joint of this robot moves", "an arm has revolute or prismatic joints");
  auto const reached = movable(tree, best);
  if (reached.size() == all.size()) return best.back();
  for (auto const& name : reached) all.erase(name);
  refuse(urdf_place(text, "joint", *all.begin()),
         fmt::format("this robot has branches: not every joint is on the way to \"{}\"", best.back()),
         "name the link where the arm ends in a robot file of your own: [robot] urdf = \"...\", tip = \"...\"",
         {fmt::format("on the way: {}", fmt::join(reached, ", ")), fmt::format("beside it: {}", fmt::join(all, ", "))});
}

class ChainMaker {
 public:
  ChainMaker(RobotText const& text, UrdfTree const& tree, std::string const& tip)
      : text_(text), tree_(tree), path_(path_to(tree, tip)), joints_(movable(tree, path_)) {}

  SerialChain make() {
    refuse_followers();
    chain_.name = tree_.name;
    chain_.remarks = tree_.remarks;
    set_joints();
    merge_links();
    chain_.gravity = chain_.base.rotation.transpose() * Eigen::Vector3d(0.0, 0.0, -9.81);
    return std::move(chain_);
  }

 private:
  bool in_arm(std::string const& joint) const {
    return std::find(joints_.begin(), joints_.end(), joint) != joints_.end();
  }

  // a joint that follows one of the arm's moves with it, which a serial arm cannot say
  void refuse_followers() const {
    if (joints_.empty())
      refuse(text_.whole(),
             fmt::format("no joint moves on the way to \"{}\"", path_.empty() ? tree_.root : path_.back()),
             "name a link behind the arm's joints as tip");
    for (auto const& [child, joint] : tree_.joint_to) {
      bool const on_path = std::find(path_.begin(), path_.end(), child) != path_.end();
      if (joint.mimics.empty() || !(on_path || in_arm(joint.mimics))) continue;
      refuse(urdf_place(text_, "joint", joint.joint.name, "mimic"),
             fmt::format("joint \"{}\" follows \"{}\", so the arm is not serial", joint.joint.name, joint.mimics),
             "let the arm end before them ([robot] urdf = \"...\", tip = \"...\"), or make the follower fixed");
    }
  }

  void set_joints() {
    FramePose pose;
    std::vector<AxisLine> lines;
    for (auto const& link : path_) {
      auto const& joint = tree_.joint_to.at(link);
      pose = pose * joint.origin;
      poses_.push_back(pose);
      if (!joint.moves_itself()) continue;
      lines.push_back({pose.position, pose.rotation * joint.axis});
      chain_.joints.push_back(joint.joint);
    }
    set_frames(std::move(lines), chain_);
  }

  // everything that moves with a frame of the arm, at q = 0
  void merge_links() {
    std::vector<LinkInertia> links(chain_.joints.size());
    std::vector<bool> has_mass(chain_.joints.size(), false);
    FramePose frame = chain_.base;
    std::size_t next = 0;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      if (tree_.joint_to.at(path_[i]).moves_itself()) {
        frame = frame * joint_pose(chain_.joints[next], 0.0);
        ++next;
      }
      if (next == 0) continue;  // part of the base
      auto const body = body_at(path_[i], frame.inverse() * poses_[i], i + 1 < path_.size() ? path_[i + 1] : "");
      if (body) {
        links[next - 1] = links[next - 1] + *body;
        has_mass[next - 1] = true;
      }
    }
    chain_.flange = frame.inverse() * poses_.back();
    if (std::find(has_mass.begin(), has_mass.end(), true) == has_mass.end()) return;
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (has_mass[i]) continue;
      refuse(urdf_place(text_, "joint", joints_[i]),
             fmt::format("nothing behind joint \"{}\" has a mass, other links have", joints_[i]),
             "write an <inertial> with mass and inertia for its link, or for no link: identification needs none");
    }
    chain_.links = std::move(links);
  }

  // a link and what hangs on it, but for the arm's next link; nothing when all of it has no mass
  std::optional<LinkInertia> body_at(std::string const& link, FramePose const& pose, std::string const& without) {
    std::optional<LinkInertia> body;
    std::vector<std::pair<std::string, FramePose>> open{{link, pose}};
    while (!open.empty()) {
      auto const [name, at] = open.back();
      open.pop_back();
      if (auto const found = tree_.inertias.find(name); found != tree_.inertias.end())
        body = body.value_or(LinkInertia{}) + found->second.seen_from(at);
      auto const children = tree_.children.find(name);
      if (children == tree_.children.end()) continue;
      for (auto const& child : children->second) {
        if (child == without) continue;
        auto const& joint = tree_.joint_to.at(child);
        if (!joint.is_fixed)
          chain_.remarks.push_back(fmt::format("joint \"{}\" is beside the arm and held at 0", joint.joint.name));
        open.emplace_back(child, at * joint.origin);
      }
    }
    return body;
  }

  RobotText const& text_;
  UrdfTree const& tree_;
  std::vector<std::string> path_;    // child links
  std::vector<std::string> joints_;  // names of those that move
  std::vector<FramePose> poses_;     // of the links of the path, seen from the root, at q = 0
  SerialChain chain_;
};

}  // namespace

SerialChain read_urdf_chain(RobotText const& text, std::string const& tip) {
  auto const tree = read_urdf_tree(text);
  if (!tip.empty() && !tree.joint_to.contains(tip)) {
    std::vector<std::string> names;
    for (auto const& [child, joint] : tree.joint_to) names.push_back(child);
    auto const close = closest_name(tip, names);
    refuse(text.whole(),
           fmt::format("{} has no link \"{}\"{}", text.file, tip,
                       close.empty() ? "" : fmt::format("; did you mean \"{}\"?", close)),
           fmt::format("its links: {}", fmt::join(names, ", ")));
  }
  return ChainMaker(text, tree, tip.empty() ? only_tip(text, tree) : tip).make();
}

}  // namespace torquescope
