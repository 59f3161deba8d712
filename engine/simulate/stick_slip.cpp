#include "engine/simulate/stick_slip.hpp"

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

// where a free joint cannot stay as it is
Contact consequence(Contact contact, double acceleration, double reaction, DryBranches const& dry) {
  if (contact == Contact::held)
    return reaction > dry.forward ? Contact::forward : reaction < dry.backward ? Contact::backward : Contact::held;
  bool const comes_back = contact == Contact::forward ? acceleration < 0.0 : acceleration > 0.0;
  return comes_back ? Contact::held : contact;
}

// x = matrix^-1 x by L D L', which takes the matrix's lower half
void solve_in_place(Eigen::MatrixXd& matrix, Eigen::VectorXd& x) {
  Index const n = x.size();
  for (Index j = 0; j < n; ++j) {
    for (Index k = 0; k < j; ++k) matrix(j, j) -= matrix(j, k) * matrix(j, k) * matrix(k, k);
    for (Index i = j + 1; i < n; ++i) {
      for (Index k = 0; k < j; ++k) matrix(i, j) -= matrix(i, k) * matrix(j, k) * matrix(k, k);
      matrix(i, j) /= matrix(j, j);
    }
  }
  for (Index i = 1; i < n; ++i)
    for (Index k = 0; k < i; ++k) x[i] -= matrix(i, k) * x[k];
  for (Index i = 0; i < n; ++i) x[i] /= matrix(i, i);
  for (Index i = n - 2; i >= 0; --i)
    for (Index k = i + 1; k < n; ++k) x[i] -= matrix(k, i) * x[k];
}

}  // namespace

StickSlip::StickSlip(Index joints) : masked_(joints, joints), acceleration_(joints), reaction_(joints) {}

void StickSlip::accelerate(Eigen::Ref<Eigen::MatrixXd const> const& mass, Eigen::Ref<Eigen::VectorXd const> const& push,
                           std::vector<DryBranches> const& dry, std::vector<JointContact> const& contacts) {
  masked_ = mass;
  for (Index j = 0; j < push.size(); ++j) {
    auto const at = static_cast<std::size_t>(j);
    if (contacts[at].contact == Contact::held) {
      masked_.row(j).setZero();
      masked_.col(j).setZero();
      masked_(j, j) = 1.0;
      acceleration_[j] = 0.0;
    } else {
      acceleration_[j] = push[j] - (contacts[at].contact == Contact::forward ? dry[at].forward : dry[at].backward);
    }
  }
  solve_in_place(masked_, acceleration_);
}

void StickSlip::solve(Eigen::Ref<Eigen::MatrixXd const> const& mass, Eigen::Ref<Eigen::VectorXd const> const& push,
                      std::vector<DryBranches> const& dry, std::vector<JointContact>& contacts) {
  TORQUESCOPE_EXPECT(dry.size() == contacts.size() && push.size() == static_cast<Index>(dry.size()));
  for (auto& joint : contacts)
    if (joint.is_free) joint.contact = Contact::held;
  // no set of contacts comes twice; rounding may bring one back where two solutions touch
  std::size_t turns = 1;
  for (auto const& joint : contacts) turns *= joint.is_free ? 3 : 1;
  for (; turns > 0; --turns) {
    accelerate(mass, push, dry, contacts);
    reaction_.noalias() = push - mass * acceleration_;
    bool changed = false;
    for (std::size_t j = 0; j < contacts.size() && !changed; ++j) {
      if (!contacts[j].is_free) continue;
      auto const at = static_cast<Index>(j);
      Contact const next = consequence(contacts[j].contact, acceleration_[at], reaction_[at], dry[j]);
      changed = next != contacts[j].contact;
      contacts[j].contact = next;
    }
    if (!changed) return;
  }
}

}  // namespace torquescope
