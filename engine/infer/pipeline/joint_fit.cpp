#include "engine/infer/pipeline/joint_fit.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/fit/problem/least_squares.hpp"
#include "engine/infer/pipeline/joint_bounds.hpp"

namespace torquescope {
namespace {

constexpr double least_share = 1e-3;  // of what would take all torque
constexpr double light_share = 0.03;  // of a joint that a loop can hold, in place of one that is none

// parameters that share one value; one of them as a rule
using Group = std::vector<Eigen::Index>;

class JointFit {
 public:
  JointFit(ProcessedRecord& record, JointModel const& model, std::string const& name)
      : record_(record), owners_(model.column_owners()), bounds_(joint_bounds(model)), name_(name) {
    for (Eigen::Index column = 0; column < record.columns.cols(); ++column) groups_.push_back({column});
  }

  void run() {
    record_.held.clear();
    do solve();
    while (drop_most_negative() || hold_friction() || hold_inertia());
    record_.residual = record_.torque - record_.columns * record_.parameters;
  }

 private:
  void solve() {
    RegressionData data;
    for (Group const& group : groups_) data.columns.push_back(owners_[static_cast<std::size_t>(group.front())]);
    data.recording_names = {name_};
    // as long as all columns are there, they are lent and not copied
    bool const lends = inertia_ == JointBounds::none && groups_.size() == owners_.size();
    data.phi = lends ? std::move(record_.columns) : grouped_columns();
    data.tau = lends ? std::move(record_.torque) : torque_beside_inertia();
    Eigen::VectorXd const solved = solve_weighted(data, {});
    if (lends) {
      record_.columns = std::move(data.phi);
      record_.torque = std::move(data.tau);
    }
    record_.parameters = Eigen::VectorXd::Zero(record_.columns.cols());
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (Eigen::Index column : groups_[g]) record_.parameters[column] = solved[static_cast<Eigen::Index>(g)];
    if (inertia_ != JointBounds::none) record_.parameters[inertia_] = held_inertia_;
  }

  Eigen::MatrixXd grouped_columns() const {
    Eigen::MatrixXd sums(record_.columns.rows(), static_cast<Eigen::Index>(groups_.size()));
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      auto sum = sums.col(static_cast<Eigen::Index>(g));
      sum = record_.columns.col(groups_[g].front());
      for (std::size_t k = 1; k < groups_[g].size(); ++k) sum += record_.columns.col(groups_[g][k]);
    }
    return sums;
  }

  Eigen::VectorXd torque_beside_inertia() const {
    if (inertia_ == JointBounds::none) return record_.torque;
    return record_.torque - held_inertia_ * record_.columns.col(inertia_);
  }

  // a parameter of an effect that would be negative where it cannot be; the most negative first, others are asked again
  bool drop_most_negative() {
    auto worst = groups_.end();
    double least = 0.0;
    for (auto group = groups_.begin(); group != groups_.end(); ++group) {
      Eigen::Index const column = group->front();
      double const value = record_.parameters[column];
      if (!bounds_.non_negative[static_cast<std::size_t>(column)] || !(value < 0.0)) continue;
      double const size = value * record_.columns.col(column).norm();
      if (worst != groups_.end() && size >= least) continue;
      worst = group;
      least = size;
    }
    if (worst == groups_.end()) return false;
    groups_.erase(worst);
    return true;
  }

  // the parameter by itself, while it counts
  std::vector<Group>::iterator group_of(Eigen::Index column) {
    return std::find(groups_.begin(), groups_.end(), Group{column});
  }

  bool hold_friction() {
    auto const both = group_of(bounds_.friction);
    if (both != groups_.end() && record_.parameters[bounds_.friction] < 0.0) {
      groups_.erase(both);
      record_.held = "dry friction";
      return true;
    }
    auto const forward = group_of(bounds_.forward), backward = group_of(bounds_.backward);
    if (forward == groups_.end() || backward == groups_.end() ||
        record_.parameters[bounds_.forward] >= record_.parameters[bounds_.backward])
      return false;
    // one value in both directions: an offset
    forward->push_back(bounds_.backward);
    groups_.erase(backward);
    record_.held = "dry friction";
    return true;
  }

  bool hold_inertia() {
    Eigen::Index const column = bounds_.inertia;
    auto const group = group_of(column);
    if (group == groups_.end()) return false;
    double const acceleration = record_.columns.col(column).norm();
    if (!(acceleration > 0.0)) return false;
    double const all_of_torque = record_.torque.norm() / acceleration;
    if (record_.parameters[column] >= least_share * all_of_torque) return false;
    inertia_ = column;
    held_inertia_ = light_share * all_of_torque;
    groups_.erase(group);
    record_.held = "inertia";
    return true;
  }

  ProcessedRecord& record_;
  std::vector<RegressorColumn> owners_;
  JointBounds bounds_;
  std::string const& name_;
  std::vector<Group> groups_;
  Eigen::Index inertia_ = JointBounds::none;  // held at its bound
  double held_inertia_ = 0.0;
};

}  // namespace

void fit_joint(ProcessedRecord& record, JointModel const& model, std::string const& name) {
  JointFit(record, model, name).run();
}

}  // namespace torquescope
