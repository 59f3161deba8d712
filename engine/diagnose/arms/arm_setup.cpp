#include "engine/diagnose/arms/arm_setup.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

namespace torquescope {
namespace {

using Eigen::Index;

void append_rows(Eigen::MatrixXd& to, Eigen::MatrixXd const& more) {
  Index const before = to.rows();
  to.conservativeResize(before + more.rows(), more.cols());
  to.bottomRows(more.rows()) = more;
}

}  // namespace

void ArmSamples::add(std::vector<Motion> const& motion, std::vector<std::vector<bool>> const& moving, Index edge,
                     Index most, OutsideTorques const& outside_torques) {
  Index const n = motion.front().q.size() - 2 * edge;
  if (n < 2) return;
  Index const step = std::max<Index>(1, (n + most - 1) / most), rows = (n - 1) / step + 1;
  auto const joints = static_cast<Index>(motion.size());
  ArmSamples more;
  more.time_s.resize(rows);
  for (Index k = 0; k < rows; ++k) more.time_s[k] = motion.front().time_s[edge + k * step];
  for (auto* channel : {&more.q, &more.dq, &more.ddq, &more.tau, &more.moves}) channel->resize(rows, joints);
  for (Index j = 0; j < joints; ++j) {
    Motion const& of = motion[static_cast<std::size_t>(j)];
    auto const& moves_j = moving[static_cast<std::size_t>(j)];
    for (Index k = 0; k < rows; ++k) {
      Index const at = edge + k * step;
      more.q(k, j) = of.q[at];
      more.dq(k, j) = of.dq[at];
      more.ddq(k, j) = of.ddq[at];
      more.tau(k, j) = of.torque[at];
      more.moves(k, j) = moves_j[static_cast<std::size_t>(at)] ? 1.0 : 0.0;
    }
  }
  begins.push_back(size());
  time_s.conservativeResize(size() + rows);
  time_s.tail(rows) = more.time_s;
  append_rows(q, more.q);
  append_rows(dq, more.dq);
  append_rows(ddq, more.ddq);
  append_rows(tau, more.tau);
  append_rows(moves, more.moves);
  if (outside_torques.as_read.size() == 0) return;
  auto const taken = Eigen::seqN(edge, rows, step);
  append_rows(outside, outside_torques.as_read(taken, Eigen::all));
  append_rows(outside_otherwise, outside_torques.otherwise(taken, Eigen::all));
}

ArmSetup setup_as_read(SerialChain const& chain) {
  Index const n = chain.size();
  std::vector<Index> own(static_cast<std::size_t>(n));
  std::iota(own.begin(), own.end(), Index{0});
  return {chain, own, own, Eigen::VectorXd::Ones(n), Eigen::VectorXd::Ones(n), Eigen::VectorXd::Zero(n)};
}

ArmSetup changed(ArmSetup setup, SetupChange const& change, SerialChain otherwise) {
  Index const j = change.joint;
  auto const exchange = [&](std::vector<Index>& of) {
    std::swap(of[static_cast<std::size_t>(j)], of[static_cast<std::size_t>(change.other)]);
  };
  switch (change.kind) {
    case SetupKind::joint_sign:
      setup.position_factor[j] *= -1.0;
      setup.torque_factor[j] *= -1.0;
      break;
    case SetupKind::torque_sign:
      setup.torque_factor[j] *= -1.0;
      break;
    case SetupKind::position_sign:
      setup.position_factor[j] *= -1.0;
      break;
    case SetupKind::joints_exchanged:
      exchange(setup.position_of);
      exchange(setup.torque_of);
      break;
    case SetupKind::positions_exchanged:
      exchange(setup.position_of);
      break;
    case SetupKind::torques_exchanged:
      exchange(setup.torque_of);
      break;
    case SetupKind::dh_convention:
      std::swap(setup.chain.gravity, otherwise.gravity);  // an earlier change may have turned it
      std::swap(setup.chain, otherwise);
      setup.is_of_other_convention = true;
      break;
    case SetupKind::gravity:
      setup.chain.gravity =
          setup.chain.base.rotation.transpose() * (Eigen::AngleAxisd(change.number, Eigen::Vector3d::Unit(j)) *
                                                   (setup.chain.base.rotation * setup.chain.gravity));
      break;
    case SetupKind::position_factor:
      if (j < 0)
        setup.position_factor *= change.number;
      else
        setup.position_factor[j] *= change.number;
      break;
    case SetupKind::no_gravity:
      setup.chain.gravity.setZero();
      break;
    case SetupKind::motor_side:
      for (Index k = 0; k < setup.chain.size(); ++k)
        setup.torque_factor[k] *= setup.chain.joints[static_cast<std::size_t>(k)].gear_ratio;
      break;
    case SetupKind::torque_factor:
      if (j < 0)
        setup.torque_factor *= change.number;
      else
        setup.torque_factor[j] *= change.number;
      break;
    case SetupKind::zero:
      setup.zero[j] += change.number;
      break;
  }
  return setup;
}

ArmSamples taken_as(ArmSamples const& samples, ArmSetup const& setup) {
  ArmSamples taken = samples;
  for (Index j = 0; j < samples.q.cols(); ++j) {
    Index const p = setup.position_of[static_cast<std::size_t>(j)], t = setup.torque_of[static_cast<std::size_t>(j)];
    double const factor = setup.position_factor[j];
    taken.q.col(j) = (factor * samples.q.col(p)).array() + setup.zero[j];
    taken.dq.col(j) = factor * samples.dq.col(p);
    taken.ddq.col(j) = factor * samples.ddq.col(p);
    taken.moves.col(j) = samples.moves.col(p);
    taken.tau.col(j) = setup.torque_factor[j] * samples.tau.col(t);
  }
  return taken;
}

}  // namespace torquescope
