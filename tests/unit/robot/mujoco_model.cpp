#include "unit/robot/mujoco_model.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace torquescope::test {

namespace {

std::string xml_of(SerialChain const& chain) {
  std::ostringstream xml;
  xml << "<mujoco><option gravity='0 0 0'/>"
      << "<compiler angle='radian'/><worldbody>";
  for (auto const& joint : chain.joints)
    xml << "<body><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><joint axis='0 0 1' type='"
        << (joint.kind == JointKind::revolute ? "hinge" : "slide") << "'/>";
  for (std::size_t i = 0; i < chain.joints.size(); ++i) xml << "</body>";
  xml << "</worldbody></mujoco>";
  return xml.str();
}

void write(double* to, Eigen::Quaterniond const& turn) {
  to[0] = turn.w();
  to[1] = turn.x();
  to[2] = turn.y();
  to[3] = turn.z();
}

}  // namespace

MujocoModel::MujocoModel(std::string const& xml) : model_(nullptr, mj_deleteModel), data_(nullptr, mj_deleteData) {
  TemporaryFolder const folder;
  auto const file = folder.path() / "arm.xml";
  std::ofstream(file) << xml;
  std::array<char, 1000> message{};
  model_.reset(mj_loadXML(file.c_str(), nullptr, message.data(), static_cast<int>(message.size())));
  if (!model_) throw std::runtime_error(message.data());
  model_->opt.disableflags |= mjDSBL_CONSTRAINT | mjDSBL_CONTACT;
  data_.reset(mj_makeData(model_.get()));
}

MujocoModel MujocoModel::of_xml(std::string const& xml) { return MujocoModel(xml); }

MujocoModel::MujocoModel(SerialChain const& chain) : MujocoModel(xml_of(chain)) {
  for (int k = 0; k < 3; ++k) model_->opt.gravity[k] = chain.gravity[k];
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    std::size_t const body = i + 1;  // 0 is the world
    auto const pose = joint_pose(chain.joints[i], 0.0);
    auto const& link = chain.links[i];
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const axes(link.about_centre());
    Eigen::Matrix3d turn = axes.eigenvectors();
    if (turn.determinant() < 0.0) turn.col(0) = -turn.col(0);
    for (Eigen::Index k = 0; k < 3; ++k) {
      std::size_t const at = 3 * body + static_cast<std::size_t>(k);
      model_->body_pos[at] = pose.position[k];
      model_->body_ipos[at] = link.first_moment[k] / link.mass;
      model_->body_inertia[at] = axes.eigenvalues()[k];
    }
    write(model_->body_quat + 4 * body, Eigen::Quaterniond(pose.rotation).normalized());
    write(model_->body_iquat + 4 * body, Eigen::Quaterniond(turn).normalized());
    model_->body_mass[body] = link.mass;
    model_->body_sameframe[body] = 0;
    model_->dof_armature[i] = chain.joints[i].drive_inertia;
  }
  mj_setConst(model_.get(), data_.get());
}

void MujocoModel::set_state(Eigen::VectorXd const& q, Eigen::VectorXd const& dq) {
  if (q.size() != model_->nq) throw std::runtime_error("MuJoCo has another number of joints");
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    data_->qpos[i] = q[i];
    data_->qvel[i] = dq[i];
  }
}

Eigen::VectorXd MujocoModel::inverse_dynamics(Eigen::VectorXd const& q, Eigen::VectorXd const& dq,
                                              Eigen::VectorXd const& ddq) {
  set_state(q, dq);
  for (Eigen::Index i = 0; i < q.size(); ++i) data_->qacc[i] = ddq[i];
  mj_inverse(model_.get(), data_.get());
  return Eigen::VectorXd::Map(data_->qfrc_inverse, q.size());
}

Eigen::VectorXd MujocoModel::forward_dynamics(Eigen::VectorXd const& q, Eigen::VectorXd const& dq,
                                              Eigen::VectorXd const& tau) {
  set_state(q, dq);
  for (Eigen::Index i = 0; i < q.size(); ++i) data_->qfrc_applied[i] = tau[i];
  mj_forward(model_.get(), data_.get());
  return Eigen::VectorXd::Map(data_->qacc, q.size());
}

}  // namespace torquescope::test
