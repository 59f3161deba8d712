// What moves a part with an inertia of its own is not cut where the joint's motion is: a load behind a gap, integrated
// here in small steps by nothing of the engine's, is told from a position that shakes beyond the cut-off.

#include "engine/infer/pipeline/record_pipeline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace record_pipeline_test {

constexpr double half_gap = 4e-4, flank_hz = 80.0, flank_damping = 0.3, film_per_s = 20.0;
constexpr double rate_hz = 1000.0;
constexpr Eigen::Index samples = 8000;

struct Shaken {
  double q, ddq;
};

// a slow swing, and a motor that is knocked 70 times a second
Shaken shaken_at(double t) {
  double const slow = 2.0 * std::numbers::pi * 0.7, fast = 2.0 * std::numbers::pi * 70.0;
  constexpr double swing = 0.6, shake = 3e-5;
  return {swing * std::sin(slow * t) + shake * std::sin(fast * t),
          -swing * slow * slow * std::sin(slow * t) - shake * fast * fast * std::sin(fast * t)};
}

// y'' of the load relative to the motor, per sample
Eigen::VectorXd load_behind_gap() {
  constexpr int parts = 200;
  double const omega = 2.0 * std::numbers::pi * flank_hz, step_s = 1.0 / (rate_hz * parts);
  double y = -shaken_at(0.0).ddq > 0.0 ? half_gap : -half_gap, dy = 0.0;
  auto const contact = [&] {
    double const side = std::copysign(1.0, y), beyond = y - side * half_gap;
    double const push = omega * omega * beyond + 2.0 * flank_damping * omega * dy;
    return side * beyond > 0.0 && side * push > 0.0 ? -push : -film_per_s * dy;
  };
  Eigen::VectorXd accelerations(samples);
  for (Eigen::Index row = 0; row < samples; ++row) {
    double const t = static_cast<double>(row) / rate_hz;
    accelerations[row] = contact() - shaken_at(t).ddq;
    for (int part = 0; part < parts; ++part) {
      dy += step_s * (contact() - shaken_at(t + part * step_s).ddq);
      y += step_s * dy;
    }
  }
  return accelerations;
}

Recording recorded() {
  Recording recording;
  recording.name = "shaken";
  recording.rate_hz = rate_hz;
  recording.time_s = Eigen::VectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1) / rate_hz);
  recording.position = recording.time_s.unaryExpr([](double t) { return shaken_at(t).q; });
  recording.torque = Eigen::VectorXd::Zero(samples);
  return recording;
}

JointModel gap_model() {
  BaselineReference reference;
  reference.parameters = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(clean_regressor().size()));
  return {clean_regressor(),
          std::move(reference),
          {{find_effect("backlash"), {half_gap, flank_hz, flank_damping, film_per_s, 0.0}}}};
}

TEST(RecordPipeline, DrivesALoadBehindAGapBeyondTheCutOff) {
  FilterOptions filter;
  filter.cutoff_hz = 60.0;
  filter.parallel_cutoff_hz = 30.0;
  filter.decimate_to_hz = 100.0;
  RecordPipeline const pipeline(gap_model(), filter, rate_hz, samples);
  ProcessedRecord const record = pipeline.prepare(recorded());
  Eigen::VectorXd const truth = pipeline.filtered(load_behind_gap(), record);
  Eigen::VectorXd const driven = record.columns.rightCols(1);
  Eigen::MatrixXd const columns = pipeline.model().columns(record.motion, record.motion);
  Eigen::VectorXd const cut = pipeline.filtered(columns.rightCols(1).col(0), record);

  double const error = (driven - truth).norm() / truth.norm();
  EXPECT_LT(error, 0.15);  // a knock that comes a little early or late changes the next
  EXPECT_GT((cut - truth).norm() / truth.norm(), 3.0 * error);
}

}  // namespace record_pipeline_test
