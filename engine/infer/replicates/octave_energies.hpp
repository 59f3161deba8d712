#pragma once
// What a record has in each octave below the filter's cut-off, where no missing physics can pose as noise.
//
// Statistic  per octave the median over blocks of the energy of second differences over rows 0.4, 0.8, 1.6 ... periods
//            of the cut-off apart, of Hann means over half a step, which hide the encoder's louder noise
// Taken out  smooth functions of position, velocity, acceleration and jerk, with and without the motion's sign, and a
//            parabola of the friction level: missing physics lives there, noise does not
// Shapes     smooth functions are those of the recording's motion; a record's own columns go out beside them
// Units      squares of the signal's
// Threads    const object, any number of threads

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "engine/infer/pipeline/record_pipeline.hpp"

namespace torquescope {

// in rows: between what is compared, and either side of it what is averaged
struct Octave {
  std::size_t lag = 1, half = 0;
};

class OctaveEnergies {
 public:
  OctaveEnergies(ProcessedRecord const& recording, RecordPipeline const& pipeline);

  Eigen::Index count() const { return static_cast<Eigen::Index>(octaves_.size()); }
  // where the lowest octave is loudest; count() > 0
  double lowest_hz() const;

  // of its residual: one per octave, the highest first
  Eigen::VectorXd operator()(ProcessedRecord const& record) const;
  // of signals on that record's rows: octaves x signals
  Eigen::MatrixXd of(ProcessedRecord const& record, Eigen::MatrixXd const& signals) const;

 private:
  Eigen::MatrixXd smooth_;  // kept samples x functions
  std::vector<Octave> octaves_;
  double rate_hz_ = 0.0;
};

}  // namespace torquescope
