#pragma once
// Which resting joints of an arm friction holds, and the accelerations that follow: a box-constrained linear
// complementarity problem, solved exactly.
//
// Equation   M ddq + friction = push
//              moving         friction = its branch
//              at rest        held: ddq = 0 and friction in [backward, forward];
//                             forward: friction = forward and ddq >= 0; backward: likewise below
// Method     principal pivoting by the least index: one joint changes its side at a time. M is positive definite, so
//            there is one solution
// Shapes     N; M: N x N. Units SI
// Threads    one object, one thread; no allocation
// Source     Murty 1974, Opsearch 11; finite: Rohn 1990, doi:10.1007/BF01585743

#include <Eigen/Core>
#include <vector>

namespace torquescope {

// of one joint's friction. Requires backward <= forward
struct DryBranches {
  double backward = 0.0, forward = 0.0;
};

enum class Contact { backward, held, forward };

struct JointContact {
  Contact contact = Contact::forward;
  bool is_free = false;  // at rest: the contact is to be found; else it is given
};

class StickSlip {
 public:
  explicit StickSlip(Eigen::Index joints);

  // sets the contacts of free joints
  void solve(Eigen::Ref<Eigen::MatrixXd const> const& mass, Eigen::Ref<Eigen::VectorXd const> const& push,
             std::vector<DryBranches> const& dry, std::vector<JointContact>& contacts);
  Eigen::VectorXd const& acceleration() const { return acceleration_; }

 private:
  void accelerate(Eigen::Ref<Eigen::MatrixXd const> const& mass, Eigen::Ref<Eigen::VectorXd const> const& push,
                  std::vector<DryBranches> const& dry, std::vector<JointContact> const& contacts);

  Eigen::MatrixXd masked_;  // M with held joints left out; then its factors L D L'
  Eigen::VectorXd acceleration_, reaction_;
};

}  // namespace torquescope
