#include "engine/workflows/results/robot_tables.hpp"

#include <array>

#include "engine/base/error.hpp"
#include "engine/store/scale_datasets.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Member = double ChainJoint::*;

constexpr std::array<Member, 4> frame_columns{&ChainJoint::alpha, &ChainJoint::a, &ChainJoint::offset, &ChainJoint::d};
constexpr std::array<Member, 5> limit_columns{&ChainJoint::lower, &ChainJoint::upper, &ChainJoint::max_speed,
                                              &ChainJoint::max_acceleration, &ChainJoint::max_torque};
constexpr std::array<Member, 3> drive_columns{&ChainJoint::gear_ratio, &ChainJoint::drive_inertia,
                                              &ChainJoint::encoder_step};
constexpr Index pose_columns = 12;  // rotation row by row, position

void write_rows(ResultWriter& writer, std::string const& path, RowMajor const& rows, Note const& note) {
  auto const count = static_cast<std::size_t>(rows.rows()), columns = static_cast<std::size_t>(rows.cols());
  writer.numbers(path, {count, columns}, {rows.data(), count * columns}, note);
}

template <std::size_t n>
void write_joints(ResultWriter& writer, std::string const& path, SerialChain const& chain,
                  std::array<Member, n> const& columns, Note const& note) {
  RowMajor rows(chain.size(), static_cast<Index>(n));
  for (std::size_t j = 0; j < chain.joints.size(); ++j)
    for (std::size_t k = 0; k < n; ++k)
      rows(static_cast<Index>(j), static_cast<Index>(k)) = chain.joints[j].*columns[k];
  write_rows(writer, path, rows, note);
}

// rows of a dataset; 65 when it has another shape
RowMajor read_rows(ResultReader const& reader, std::string const& path, Index rows, Index columns) {
  auto const numbers = reader.numbers(path);
  h5::Shape const wanted{static_cast<std::size_t>(rows), static_cast<std::size_t>(columns)};
  validate(numbers.shape == wanted, [&] {
    return Problem{.code = ExitCode::bad_data,
                   .what = reader.name().string() + " has tables of an arm that differ in length: " + path,
                   .help = "make it again with torquescope run"};
  });
  return RowMajor::Map(numbers.values.data(), rows, columns);
}

template <std::size_t n>
void read_joints(ResultReader const& reader, std::string const& path, SerialChain& chain,
                 std::array<Member, n> const& columns) {
  RowMajor const rows = read_rows(reader, path, chain.size(), static_cast<Index>(n));
  for (std::size_t j = 0; j < chain.joints.size(); ++j)
    for (std::size_t k = 0; k < n; ++k)
      chain.joints[j].*columns[k] = rows(static_cast<Index>(j), static_cast<Index>(k));
}

void put_pose(RowMajor& rows, Index row, FramePose const& pose) {
  for (Index i = 0; i < 3; ++i) rows.block<1, 3>(row, 3 * i) = pose.rotation.row(i);
  rows.block<1, 3>(row, 9) = pose.position.transpose();
}

FramePose pose_of(RowMajor const& rows, Index row) {
  FramePose pose;
  for (Index i = 0; i < 3; ++i) pose.rotation.row(i) = rows.block<1, 3>(row, 3 * i);
  pose.position = rows.block<1, 3>(row, 9).transpose();
  return pose;
}

}  // namespace

void write_robot_tables(ResultWriter& writer, SerialChain const& chain) {
  std::vector<std::string> names, kinds;
  for (auto const& joint : chain.joints) {
    names.push_back(joint.name);
    kinds.push_back(joint.kind == JointKind::revolute ? "revolute" : "prismatic");
  }
  writer.attribute("/robot", "name", chain.name);
  writer.attribute("/robot", "gravity", std::vector<double>{chain.gravity.x(), chain.gravity.y(), chain.gravity.z()});
  writer.texts("/robot/joints", names, Note{"1", "joint names, from the base to the tip"}.over({"joint"}));
  write_names(writer, "/robot", "joint", names);
  writer.texts("/robot/kinds", kinds, Note{"1", "how each joint moves"}.over({"joint"}));
  write_joints(writer, "/robot/frames", chain, frame_columns,
               {"SI", "alpha, a, offset, d: modified Denavit-Hartenberg"});
  write_joints(writer, "/robot/limits", chain, limit_columns,
               {"SI", "lower, upper, largest speed, acceleration, torque; infinite: none"});
  write_joints(writer, "/robot/drives", chain, drive_columns,
               {"SI", "gear ratio, drive inertia, encoder step; 0: unknown"});
  RowMajor poses(2, pose_columns);
  put_pose(poses, 0, chain.base);
  put_pose(poses, 1, chain.flange);
  write_rows(writer, "/robot/poses", poses, {"m", "frame 0 and the tool: rotation row by row, position"});
  if (chain.has_coupled_drives())
    write_rows(writer, "/robot/transmission", chain.transmission, {"SI", "turns of each motor per turn of each joint"});
  if (!chain.has_inertias()) return;
  RowMajor links(chain.size(), numbers_per_link);
  for (Index i = 0; i < chain.size(); ++i) links.row(i) = chain.links[static_cast<std::size_t>(i)].vector().transpose();
  write_rows(writer, "/robot/links", links, {"SI", "m, mx, my, mz, xx, xy, xz, yy, yz, zz of the robot file"});
}

StoredRobot read_robot_tables(ResultReader const& reader) {
  auto const names = reader.texts("/robot/joints"), kinds = reader.texts("/robot/kinds");
  auto const gravity = reader.attribute<std::vector<double>>("/robot", "gravity");
  validate(!names.empty() && kinds.size() == names.size() && gravity.size() == 3, [&] {
    return Problem{.code = ExitCode::bad_data,
                   .what = reader.name().string() + " has tables of an arm that differ in length",
                   .help = "make it again with torquescope run"};
  });
  StoredRobot robot;
  auto& chain = robot.chain;
  chain.name = reader.attribute<std::string>("/robot", "name");
  chain.gravity = Eigen::Vector3d::Map(gravity.data());
  for (std::size_t i = 0; i < names.size(); ++i) {
    ChainJoint joint;
    joint.name = names[i];
    joint.kind = kinds[i] == "prismatic" ? JointKind::prismatic : JointKind::revolute;
    chain.joints.push_back(std::move(joint));
  }
  read_joints(reader, "/robot/frames", chain, frame_columns);
  robot.has_limits = reader.exists("/robot/limits");
  if (!robot.has_limits) return robot;
  read_joints(reader, "/robot/limits", chain, limit_columns);
  read_joints(reader, "/robot/drives", chain, drive_columns);
  RowMajor const poses = read_rows(reader, "/robot/poses", 2, pose_columns);
  chain.base = pose_of(poses, 0);
  chain.flange = pose_of(poses, 1);
  if (reader.exists("/robot/transmission"))
    chain.transmission = read_rows(reader, "/robot/transmission", chain.size(), chain.size());
  if (!reader.exists("/robot/links")) return robot;
  RowMajor const links = read_rows(reader, "/robot/links", chain.size(), numbers_per_link);
  for (Index i = 0; i < chain.size(); ++i) chain.links.push_back(LinkInertia::from_vector(links.row(i).transpose()));
  return robot;
}

}  // namespace torquescope
