#pragma once
// The model of one joint: terms stacked as columns, and who owns which column.
//
// Equation   tau = columns(motion) * parameters; sum over the terms, in the order the job lists them
// Shapes     columns: n_samples x size(), column-major, at the full rate (before the parallel filter)
// Units      SI; units() are those of the joint's kind
// Errors     Error 78, all problems at once: unknown, repeated or redundant terms, none, an angle's effect on a slide
// Threads    const object, any number of threads
// Source     Gautier, Khalil 1990, doi:10.1109/70.56655; a deadband of 0 is the seed paper's sign(0) = 0

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/effects/effect.hpp"

namespace torquescope {

// one column of the regressor
struct RegressorColumn {
  std::string name;             // of the parameter: "gravity_sin"
  std::string unit;             // of the parameter: "N m"
  std::size_t term = 0;         // index into terms(): whose column this is
  bool needs_position = false;  // which part of the motion the column depends on, hence
  bool needs_velocity = false;  // what must vary in a recording to see it
  bool needs_acceleration = false;
  bool needs_time = false;
};

class Regressor {
 public:
  // `model`: the job's [model] section, for the places in messages
  Regressor(std::vector<std::string> const& terms, JointKind joint, double velocity_deadband = 0.0,
            Section const& model = {});

  // the same beside a term whose columns come with a recording (given_effect.hpp); it outlives the regressor
  Regressor beside(Effect const& given) const;

  std::size_t size() const { return columns_.size(); }  // parameters
  JointKind joint() const { return joint_; }
  double velocity_deadband() const { return velocity_deadband_; }
  std::vector<Effect const*> const& terms() const { return terms_; }
  std::vector<RegressorColumn> const& column_owners() const { return columns_; }
  std::vector<std::string> names() const;  // of the parameters
  std::vector<std::string> units() const;
  std::string equation() const;  // "tau = J ddq + Fv dq + Fc sign(dq)"

  // given: of the recording; none: zeros in columns of a given term
  Eigen::MatrixXd columns(Motion const& motion, GivenSignals const* given = nullptr) const;
  // those of one term only; a term is an instant's: any stretch of the motion gives its rows
  void columns_of_term(Motion const& motion, std::size_t term, Eigen::Ref<Eigen::MatrixXd> out,
                       GivenSignals const* given = nullptr) const;
  double torque(JointState const& state, std::span<double const> parameters) const;

 private:
  // dry friction sees a joint slower than the deadband at rest; every other effect sees the true velocity
  double seen_velocity(Effect const& effect, double velocity) const;

  JointKind joint_;
  double velocity_deadband_;
  std::vector<Effect const*> terms_;
  std::vector<RegressorColumn> columns_;
};

}  // namespace torquescope
