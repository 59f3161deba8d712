#pragma once
// The random walk of the dry friction level: how much of it a joint has without any missing physics.
//
// Equation   mean square over blocks (24, of 2 s at least) of the level read from the residual, beside smooth functions
//            of position, velocity, acceleration and a parabola over time; the largest fifth of the blocks is left out
// By itself  the same beside the parabola alone: the reading that a change over time must stand against
// At most    3 % of the level in a minute; more is a drift, for the search to find (METHOD.md, Replicates)
// Unit       share of the level per square root of a second (TwinLoop::friction_wander)
// None       no dry friction, or a recording too short for eight blocks
// Threads    spreads replicates over the threads and processes of `workers`; same bits for any number
// Source     METHOD.md, Replicates; modes of a walk about its mean: Watson 1961, doi:10.1093/biomet/48.1-2.109

#include <cstddef>
#include <vector>

#include "engine/infer/replicates/noise_level.hpp"

namespace torquescope {

inline constexpr double most_wander_in_a_minute = 0.03;

enum class WanderReading { beside_motion, by_itself };

// the statistic of any record that went through this pipeline, which outlives it; functions of the motion are those of
// `recording`
class FrictionWander {
 public:
  FrictionWander(ProcessedRecord const& recording, RecordPipeline const& pipeline, TwinJoint const& joint,
                 WanderReading reading);

  bool is_measurable() const { return blocks_ > 0; }
  double duration_s() const { return duration_s_; }
  Eigen::VectorXd const& friction() const { return friction_; }  // torque of dry friction at every kept sample
  // change of the level in each block, as a share; NaN where too few rows are left
  std::vector<double> changes(ProcessedRecord const& record) const;
  double operator()(ProcessedRecord const& record) const;

 private:
  RecordPipeline const* pipeline_;
  std::size_t blocks_ = 0;  // 0: not measurable
  double duration_s_ = 0.0;
  Eigen::MatrixXd smooth_;    // kept samples x functions
  Eigen::VectorXd friction_;  // kept samples: torque of dry friction
};

// a random walk that the twin has already is not used
NoiseLevel friction_wander(ProcessedRecord const& recording, CleanTwin const& twin, RecordPipeline const& pipeline,
                           WanderReading reading, TwinAddress const& address, std::size_t twins,
                           TwinWorkers const& workers);

}  // namespace torquescope
