#pragma once
// The motion that a fit has seen, and what of another recording lies outside of it: there a prediction extrapolates.
//
// Equation   variance of a prediction: s^2 (1 + h), h(x) = m x (X'X)^+ x' of the model's columns x before the filter;
//            X: those of the training recordings, m: samples that repeat each other. Outside: h above 1, where what the
//            parameters are uncertain by is more than the noise; and what the filter smears of that
// Why        a homing move at a hundred times the speed of the test does not test a model, and has the largest error
// Shapes     columns: n x p; coordinates: p x rank, h is the squared norm of x coordinates
// Threads    const object, free functions
// Source     variance of a prediction, hidden extrapolation: Montgomery, Peck, Vining 2012, Introduction to Linear
//            Regression Analysis, sections 3.5 and 3.8, ISBN 978-0-470-54281-1

#include <Eigen/Core>
#include <vector>

namespace torquescope {

struct TrainedMotion {
  Eigen::MatrixXd coordinates{};
};

// memory: samples that repeat each other
TrainedMotion trained_motion(Eigen::MatrixXd const& columns, double memory);

// true where a sample is outside, or within `reach` of one that is
std::vector<bool> samples_outside(TrainedMotion const& trained, Eigen::MatrixXd const& columns, Eigen::Index reach);

}  // namespace torquescope
