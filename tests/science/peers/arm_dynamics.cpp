// What the engine says of an arm in given states, for a program that compares it with others.
//
// Use        arm_dynamics ROBOT < STATES, JSON in and out: STATES is {"q", "dq", "ddq", "tau": a list of N each}
// Gives      base: the columns that stand; for each state: frames (16 numbers of every link's frame in the file's base
//            frame, row by row), regressor (N x 11 N, row by row), torque, gravity, mass_matrix, acceleration, and
//            acceleration_of_base from the base parameters alone
// Requires   a robot with inertias
#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/robot/base_parameters.hpp"
#include "engine/robot/forward_dynamics.hpp"
#include "engine/robot/robot_registry.hpp"

namespace torquescope {
namespace {

using nlohmann::json;

std::vector<double> row_by_row(Eigen::MatrixXd const& matrix) {
  std::vector<double> numbers;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) numbers.push_back(matrix(i, j));
  return numbers;
}

Eigen::VectorXd vector_of(json const& numbers) {
  auto const read = numbers.get<std::vector<double>>();
  return Eigen::VectorXd::Map(read.data(), static_cast<Eigen::Index>(read.size()));
}

json frames_of(SerialChain const& chain, Eigen::VectorXd const& q) {
  auto frames = json::array();
  FramePose pose = chain.base;
  for (Eigen::Index i = 0; i < chain.size(); ++i) {
    pose = pose * joint_pose(chain.joints[static_cast<std::size_t>(i)], q[i]);
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = pose.rotation;
    matrix.topRightCorner<3, 1>() = pose.position;
    frames.push_back(row_by_row(matrix));
  }
  return frames;
}

json answers_of(SerialChain const& chain, json const& state) {
  auto const q = vector_of(state.at("q")), dq = vector_of(state.at("dq")), ddq = vector_of(state.at("ddq"));
  auto const tau = vector_of(state.at("tau"));
  auto const chi = standard_parameters(chain, DriveInertias::included);
  BaseParameters const base(chain, DriveInertias::included);
  auto const reduced = base.to_standard(base.from_standard(chi));
  return {{"frames", frames_of(chain, q)},
          {"regressor", row_by_row(arm_regressor(chain, q, dq, ddq, DriveInertias::included))},
          {"torque", row_by_row(inverse_dynamics(chain, chi, q, dq, ddq))},
          {"gravity", row_by_row(gravity_torque(chain, chi, q))},
          {"mass_matrix", row_by_row(mass_matrix(chain, chi, q))},
          {"acceleration", row_by_row(forward_dynamics(chain, chi, q, dq, tau))},
          {"acceleration_of_base", row_by_row(forward_dynamics(chain, reduced, q, dq, tau))}};
}

int answer(char const* robot) {
  auto const chain = read_robot(robot);
  json told{{"base", BaseParameters(chain, DriveInertias::included).columns()}, {"states", json::array()}};
  for (auto const& state : json::parse(std::cin)) told["states"].push_back(answers_of(chain, state));
  std::cout << told << '\n';
  return 0;
}

}  // namespace
}  // namespace torquescope

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "arm_dynamics ROBOT < STATES\n";
    return 64;
  }
  return torquescope::answer(words[1]);
}
