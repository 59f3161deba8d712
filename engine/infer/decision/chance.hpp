#pragma once
// What chance does to the gains of a catalogue: D of every effect in replicates of the model, and p of a recording's.
//
// Equation   T = D / (c + s): s, the rms of the effect's D in replicates; c = 3.84, what one parameter reaches by
//            chance once in twenty. Effects that gain much by chance count less, and the little that others gain
//            decides nothing. A replicate's s are those of the others.
//            p = (1 + replicates whose largest T over the catalogue reaches it) / (M + 1)
// Level      of an effect by itself: D that a share alpha of its replicates reach
// Shapes     gains: effects x replicates
// Threads    plain record, pure functions
// Source     max-T: Westfall, Young 1993, Resampling-Based Multiple Testing, ISBN 978-0-471-55761-6; a constant beside
//            the scale: Tusher, Tibshirani, Chu 2001, doi:10.1073/pnas.091062498; c: Wilks 1938,
//            doi:10.1214/aoms/1177732360; p: Davison, Hinkley 1997, section 4.2, doi:10.1017/CBO9780511802843

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace torquescope {

// the smallest of them that a share alpha does not exceed; values: at least one
double value_of_chance(std::vector<double> values, double alpha);

// effects: none where a catalogue is used up
struct Chance {
  Eigen::MatrixXd gains{};

  std::size_t replicates() const { return static_cast<std::size_t>(gains.cols()); }
  void add(Eigen::MatrixXd const& further);
  Eigen::VectorXd p(Eigen::VectorXd const& gains_of_recording) const;         // of every effect
  Eigen::VectorXd relative(Eigen::VectorXd const& gains_of_recording) const;  // T of every effect
  Eigen::VectorXd level(double alpha) const;                                  // of every effect
  Eigen::VectorXd needed(double alpha) const;  // D of every effect above which its p is alpha

 private:
  std::vector<double> largest() const;  // T of every replicate
};

}  // namespace torquescope
