#include "engine/robot/robot_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/robot/axis_frames.hpp"
#include "engine/robot/robot_limbs.hpp"
#include "engine/robot/xml_words.hpp"

namespace torquescope {

namespace {

[[noreturn]] void refuse(SourcePlace place, std::string what, std::string help) {
  Problem problem;
  problem.what = std::move(what);
  problem.place = std::move(place);
  problem.help = std::move(help);
  throw Error(std::move(problem));
}

SourcePlace whole_file(std::string const& file) { return {file, 0, 0, 0, ""}; }

bool holds(std::vector<std::string> const& names, std::string const& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void require_link(std::string const& file, RobotTree const& tree, std::string const& link, char const* key) {
  if (link.empty() || link == tree.root || tree.joint_to.contains(link)) return;
  std::vector<std::string> names{tree.root};
  for (auto const& [child, joint] : tree.joint_to)
    if (!joint.is_part_of_one) names.push_back(child);
  auto const close = closest_name(link, names);
  refuse(whole_file(file),
         fmt::format("{} has no link \"{}\", which is written as {}{}", file, link, key,
                     close.empty() ? "" : fmt::format("; did you mean \"{}\"?", close)),
         fmt::format("its links: {}", fmt::join(names, ", ")));
}

class ChainMaker {
 public:
  ChainMaker(std::string const& file, RobotTree const& tree, std::string const& root, std::string const& tip)
      : file_(file), tree_(tree), path_(path_to(tree, tip)) {
    if (root == tree.root) return;
    auto const at = std::find(path_.begin(), path_.end(), root);
    if (at == path_.end())
      refuse(whole_file(file), fmt::format("root = \"{}\" is not on the way to \"{}\"", root, tip),
             fmt::format("on the way: {}", path_.empty() ? tree.root : fmt::format("{}", fmt::join(path_, ", "))));
    first_ = static_cast<std::size_t>(at - path_.begin()) + 1;
  }

  SerialChain make() {
    for (std::size_t i = 0; i < path_.size(); ++i)
      if (moves(i)) joints_.push_back(joint_at(i).joint.name);
    if (joints_.empty())
      refuse(whole_file(file_),
             fmt::format("no joint moves on the way to \"{}\"", path_.empty() ? tree_.root : path_.back()),
             "name a link behind the arm's joints as tip");
    refuse_floating();
    refuse_followers();
    chain_.name = tree_.name;
    chain_.remarks = tree_.remarks;
    chain_.warnings = tree_.warnings;
    tell_what_is_held();
    tell_couplings();
    tell_effects();
    set_joints();
    merge_links();
    chain_.gravity = chain_.base.rotation.transpose() * tree_.gravity;
    set_positions();
    return std::move(chain_);
  }

 private:
  TreeJoint const& joint_at(std::size_t i) const { return tree_.joint_to.at(path_[i]); }
  bool moves(std::size_t i) const { return i >= first_ && joint_at(i).moves_itself(); }

  void refuse_floating() const {
    for (std::size_t i = first_; i < path_.size(); ++i) {
      auto const& joint = joint_at(i);
      if (joint.motion != JointMotion::floats) continue;
      refuse(joint.place, fmt::format("joint \"{}\" floats, and it is part of the arm", joint.joint.name),
             fmt::format("an arm begins behind it: write root = \"{}\" beside the robot file, or make it fixed",
                         joint.child));
    }
  }

  // a joint that follows one of the arm's moves with it, which a serial arm cannot say
  void refuse_followers() const {
    for (auto const& [child, joint] : tree_.joint_to) {
      bool const on_path =
          std::find(path_.begin() + static_cast<std::ptrdiff_t>(first_), path_.end(), child) != path_.end();
      if (joint.mimics.empty() || !(on_path || holds(joints_, joint.mimics))) continue;
      refuse(joint.place,
             fmt::format("joint \"{}\" follows \"{}\", so the arm is not serial", joint.joint.name, joint.mimics),
             "let the arm end before them (tip = \"...\" beside the robot file), or make the follower fixed");
    }
  }

  void tell_what_is_held() {
    for (std::size_t i = 0; i < path_.size(); ++i)
      chain_.remarks.insert(chain_.remarks.end(), joint_at(i).remarks.begin(), joint_at(i).remarks.end());
    for (std::size_t i = 0; i < std::min(first_, path_.size()); ++i)
      if (auto const& joint = joint_at(i); joint.motion != JointMotion::fixed)
        chain_.remarks.push_back(
            fmt::format("joint \"{}\" is before the arm's root and held as the file has it", joint.joint.name));
  }

  void tell_couplings() {
    for (auto const& coupling : tree_.couplings) {
      bool const first = holds(joints_, coupling.first), second = holds(joints_, coupling.second);
      if (!first && !second) continue;
      std::string const with =
          coupling.second.empty() ? std::string("to a number") : fmt::format("to \"{}\"", coupling.second);
      chain_.warnings.push_back(fmt::format("{}: the file couples joint \"{}\" {}; the model has no such coupling",
                                            place_text(coupling.place), coupling.first, with));
    }
  }

  // friction of a file is somebody's guess: a job identifies it
  void tell_effects() {
    std::string list;
    for (std::size_t i = 0; i < path_.size(); ++i)
      if (moves(i) && !joint_at(i).effects.empty())
        list += fmt::format("{}\"{}\" {}", list.empty() ? "" : "; ", joint_at(i).joint.name,
                            fmt::join(joint_at(i).effects, ", "));
    if (!list.empty())
      chain_.remarks.push_back(fmt::format("not taken from the file, for [model] friction finds what it is: {}", list));
  }

  void set_joints() {
    FramePose pose;
    std::vector<AxisLine> lines;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      auto const& joint = joint_at(i);
      pose = pose * joint.origin;
      poses_.push_back(pose);
      if (!moves(i)) continue;
      lines.push_back({pose.position, pose.rotation * joint.axis});
      chain_.joints.push_back(joint.joint);
    }
    set_frames(std::move(lines), chain_);
  }

  // frames and inertias are those of the file's pose, in which a joint may read something else than 0
  void set_positions() {
    std::size_t next = 0;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      if (!moves(i)) continue;
      auto& joint = chain_.joints[next];
      (joint.kind == JointKind::revolute ? joint.offset : joint.d) -= joint_at(i).position_of_file;
      ++next;
    }
  }

  // everything that moves with a frame of the arm, in the file's pose
  void merge_links() {
    std::vector<LinkInertia> links(chain_.joints.size());
    std::vector<bool> has_mass(chain_.joints.size(), false);
    FramePose frame = chain_.base;
    std::size_t next = 0;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      if (moves(i)) {
        frame = frame * joint_pose(chain_.joints[next], 0.0);
        ++next;
      }
      if (next == 0) continue;  // part of the base
      auto const body = body_at(path_[i], frame.inverse() * poses_[i], i + 1 < path_.size() ? path_[i + 1] : "");
      if (body) links[next - 1] = links[next - 1] + *body;
      if (body || joint_at(i).is_part_of_one) has_mass[next - 1] = true;
    }
    chain_.flange = frame.inverse() * poses_.back();
    if (is_some_mass_unknown_) return;
    bool const is_any =
        std::any_of(links.begin(), links.end(), [](LinkInertia const& link) { return link.mass > 0.0; });
    if (!is_any) return;
    refuse_missing_masses(has_mass);
    chain_.links = std::move(links);
  }

  void refuse_missing_masses(std::vector<bool> const& has_mass) const {
    std::size_t next = 0;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      if (!moves(i)) continue;
      if (!has_mass[next])
        refuse(joint_at(i).place,
               fmt::format("nothing behind joint \"{}\" has a mass, other links have", joints_[next]),
               "write an <inertial> with mass and inertia for its link, or for no link: identification needs none");
      ++next;
    }
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
      if (auto const found = tree_.unknown_inertias.find(name); found != tree_.unknown_inertias.end()) {
        is_some_mass_unknown_ = true;
        chain_.warnings.push_back(found->second);
      }
      auto const children = tree_.children.find(name);
      if (children == tree_.children.end()) continue;
      for (auto const& child : children->second) {
        if (child == without) continue;
        auto const& joint = tree_.joint_to.at(child);
        if (joint.motion != JointMotion::fixed)
          chain_.remarks.push_back(fmt::format(
              "joint \"{}\"{} is beside the arm and held at {:g}", joint.joint.name,
              joint.mimics.empty() ? "" : fmt::format(" follows \"{}\",", joint.mimics), joint.position_of_file));
        open.emplace_back(child, at * joint.origin);
      }
    }
    return body;
  }

  std::string const& file_;
  RobotTree const& tree_;
  std::vector<std::string> path_;      // child links
  std::size_t first_ = 0;              // of the path, the first joint that belongs to the arm
  std::vector<std::string> joints_{};  // names of those that move
  std::vector<FramePose> poses_{};     // of the links of the path, seen from the root, in the file's pose
  bool is_some_mass_unknown_ = false;
  SerialChain chain_{};
};

}  // namespace

SerialChain chain_of_tree(std::string const& file, RobotTree const& tree, RobotPart const& part) {
  require_link(file, tree, part.root, "root");
  require_link(file, tree, part.tip, "tip");
  std::string const root = part.root.empty() ? tree.root : part.root;
  return ChainMaker(file, tree, root, part.tip.empty() ? only_tip(file, tree, root) : part.tip).make();
}

}  // namespace torquescope
