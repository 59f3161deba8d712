#pragma once
// What chance does to the gains of a catalogue: D of every law in replicates of the model, and p of a recording's.
//
// Equation   T = D / (1 + mean of the law's D in replicates): laws that gain much by chance count less. A replicate's
//            mean is that of the others. p = (1 + replicates whose largest T over the catalogue reaches it) / (M + 1)
// Level      of a law by itself: D that a share alpha of its replicates reach
// Shapes     gains: laws x replicates
// Threads    plain record, pure functions
// Source     max-T: Westfall, Young 1993, Resampling-Based Multiple Testing, ISBN 978-0-471-55761-6; p: Davison,
//            Hinkley 1997, section 4.2, doi:10.1017/CBO9780511802843

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace torquescope {

// the smallest of them that a share alpha does not exceed; values: at least one
double value_of_chance(std::vector<double> values, double alpha);

// laws: none where a catalogue is used up
struct Chance {
  Eigen::MatrixXd gains{};

  std::size_t replicates() const { return static_cast<std::size_t>(gains.cols()); }
  void add(Eigen::MatrixXd const& further);
  Eigen::VectorXd p(Eigen::VectorXd const& gains_of_recording) const;         // of every law
  Eigen::VectorXd relative(Eigen::VectorXd const& gains_of_recording) const;  // T of every law
  Eigen::VectorXd level(double alpha) const;                                  // of every law
  Eigen::VectorXd needed(double alpha) const;  // D of every law above which its p is alpha

 private:
  std::vector<double> largest() const;  // T of every replicate
};

}  // namespace torquescope
