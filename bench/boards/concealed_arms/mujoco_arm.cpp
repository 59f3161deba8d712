#include "concealed_arms/mujoco_arm.hpp"

#include <Eigen/Geometry>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace concealed_arms {
namespace {

template <typename... Numbers>
std::string numbers(char const* name, Numbers... values) {
  std::string text = std::string(" ") + name + "=\"";
  char one[40];
  for (double value : {static_cast<double>(values)...}) {
    std::snprintf(one, sizeof one, "%.17g ", value);
    text += one;
  }
  text.back() = '"';
  return text;
}

std::string place(char const* tag, Eigen::Vector3d const& at, Eigen::Quaterniond const& turned) {
  return std::string("<") + tag + numbers("pos", at.x(), at.y(), at.z()) +
         numbers("quat", turned.w(), turned.x(), turned.y(), turned.z());
}

Eigen::Quaterniond about_x(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()));
}
Eigen::Quaterniond about_z(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

// mass, centre and inertia of a link whose DH frame lies at (at, turned) in the body that turns with the joint
std::string inertial(Link const& link, Eigen::Vector3d const& at, Eigen::Quaterniond const& turned) {
  auto const& i = link.inertia;
  Eigen::Matrix3d own;
  own << i[0], i[1], i[2], i[1], i[3], i[4], i[2], i[4], i[5];
  Eigen::Matrix3d const r = turned.toRotationMatrix(), body = r * own * r.transpose();
  Eigen::Vector3d const centre = at + r * Eigen::Vector3d(link.centre[0], link.centre[1], link.centre[2]);
  return "<inertial" + numbers("pos", centre.x(), centre.y(), centre.z()) + numbers("mass", link.mass) +
         numbers("fullinertia", body(0, 0), body(1, 1), body(2, 2), body(0, 1), body(0, 2), body(1, 2)) + "/>";
}

}  // namespace

std::string mjcf(Arm const& arm, Gravity const& gravity) {
  std::string text = "<mujoco><compiler angle=\"radian\" balanceinertia=\"false\"/><option" +
                     numbers("gravity", gravity[0], gravity[1], gravity[2]) +
                     "><flag contact=\"disable\" constraint=\"disable\" energy=\"enable\"/></option><worldbody>";
  // where the next joint's axis lies in the body before it
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
  for (Link const& link : arm.links) {
    Eigen::Vector3d frame = Eigen::Vector3d::Zero();
    Eigen::Quaterniond frame_turned = Eigen::Quaterniond::Identity();
    if (arm.standard_dh) {  // the link's frame lies beyond its joint
      frame = {link.a, 0.0, link.d};
      frame_turned = about_x(link.alpha);
    } else {  // and here before it: what stands before theta moves the axis
      at = at + turned * (Eigen::Vector3d(link.a, 0.0, 0.0) + about_x(link.alpha) * Eigen::Vector3d(0.0, 0.0, link.d));
      turned = turned * about_x(link.alpha);
    }
    text += place("body", at, turned * about_z(link.offset)) + ">" + inertial(link, frame, frame_turned) +
            "<joint axis=\"0 0 1\"" + numbers("armature", link.drive_inertia) + "/>";
    at = frame;
    turned = frame_turned;
  }
  for (std::size_t i = 0; i < arm.links.size(); ++i) text += "</body>";
  return text + "</worldbody></mujoco>";
}

namespace {

mjModel* loaded(std::string const& text) {
  auto const files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "arm.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), "arm.xml")], text.data(), text.size());
  char error[500] = "";
  mjModel* const model = mj_loadXML("arm.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (model == nullptr) throw std::runtime_error(std::string("MuJoCo refuses the arm: ") + error);
  return model;
}

}  // namespace

MujocoArm::MujocoArm(Arm const& arm, Gravity const& gravity)
    : model_(loaded(mjcf(arm, gravity)), mj_deleteModel),
      data_(mj_makeData(model_.get()), mj_deleteData),
      mass_(arm.joints(), arm.joints()),
      bias_(arm.joints()) {}

void MujocoArm::put(Eigen::VectorXd const& q, Eigen::VectorXd const& v) {
  std::memcpy(data_->qpos, q.data(), sizeof(double) * static_cast<std::size_t>(q.size()));
  std::memcpy(data_->qvel, v.data(), sizeof(double) * static_cast<std::size_t>(v.size()));
}

void MujocoArm::update(Eigen::VectorXd const& q, Eigen::VectorXd const& v) {
  put(q, v);
  mj_kinematics(model_.get(), data_.get());
  mj_comPos(model_.get(), data_.get());
  mj_crb(model_.get(), data_.get());
  mj_comVel(model_.get(), data_.get());
  mj_fullM(model_.get(), mass_.data(), data_->qM);
  mj_rne(model_.get(), data_.get(), 0, bias_.data());
}

Eigen::VectorXd MujocoArm::inverse(Eigen::VectorXd const& q, Eigen::VectorXd const& v, Eigen::VectorXd const& a) {
  put(q, v);
  std::memcpy(data_->qacc, a.data(), sizeof(double) * static_cast<std::size_t>(a.size()));
  mj_inverse(model_.get(), data_.get());
  return Eigen::Map<Eigen::VectorXd const>(data_->qfrc_inverse, a.size());
}

double MujocoArm::energy(Eigen::VectorXd const& q, Eigen::VectorXd const& v) {
  put(q, v);
  mj_forward(model_.get(), data_.get());
  return data_->energy[0] + data_->energy[1];
}

}  // namespace concealed_arms
