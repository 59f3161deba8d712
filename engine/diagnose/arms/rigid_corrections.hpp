#pragma once
// What the rows of one joint may correct of the rigid arm that all joints share.
//
// Why        a law that the model lacks bends the shared parameters: beside the arm as fitted it hardly shows. A joint
//            is searched with those directions of the parameters free that its own rows tell most of
// Directions of the parameters' errors (one standard deviation each), by the torque they make at the joint beside its
//            own terms. On n rows of the fit its sum of squares, over the noise, is the share of what is known of a
//            direction that this joint's rows tell: those with more than half
// Columns    their torque less what the joint's own terms (acceleration, speed, its sign, a constant) imitate of it, so
//            that these keep their meaning
// Shapes     R parameters, k_j directions of joint j, n samples
// Units      torque; a direction counts standard deviations
// Threads    free functions
// Source     Frisch, Waugh 1933, doi:10.2307/1907330 (nuisance columns)

#include <Eigen/Core>
#include <memory>

#include "engine/data/motion.hpp"
#include "engine/effects/effect.hpp"

namespace torquescope {

struct RigidCorrections {
  Eigen::MatrixXd directions{};  // r x k: of the errors
  Eigen::MatrixXd own{};         // 4 x k
  Eigen::Index size() const { return directions.cols(); }
};

// what a joint's own terms imitate: acceleration, speed, its sign, a constant; n x 4
Eigen::MatrixXd own_columns(Motion const& joint);

// products of what the errors do at a joint, summed over recordings
class CorrectionSums {
 public:
  // error_torques: n x r
  void add(Motion const& joint, Eigen::MatrixXd const& error_torques);
  // noise of the joint, and its number of rows in the fit
  RigidCorrections corrections(double noise, Eigen::Index rows) const;

 private:
  Eigen::MatrixXd errors_{}, beside_{}, own_{};
  Eigen::Index samples_ = 0;
};

// n x k
Eigen::MatrixXd correction_columns(RigidCorrections const& corrections, Motion const& joint,
                                   Eigen::MatrixXd const& error_torques);

inline constexpr char const* corrections_name = "rigid_correction";
// the term of a joint's model with these columns (GivenSignals under corrections_name); k > 0
std::unique_ptr<Effect const> correction_term(Eigen::Index directions);

}  // namespace torquescope
