#pragma once
// How much dry friction wanders by itself: no joint keeps its level to the last per mille, and a slow wander passes for
// any effect of time, and for a little of everything, when the twins have none.
//
// Statistic  the residual, less every smooth function of position, velocity and acceleration that it holds and a
//            parabola of the level over time, read as a change of the level of dry friction, block by block (24, of 2 s
//            at least); mean square over the blocks, the largest fifth left out: a drift that goes on is no wander, nor
//            is an event
// By itself  the same with nothing but the parabola taken out: more, when something else is missing, seldom less. Where
//            a motion takes its speeds one after the other, functions of the motion can pose as any wander; whoever
//            names a drift must do so against this reading
// Rows       whitened as the pipeline whitens: the noise of the encoder hides slow changes, and an uncertain level
//            makes twins that differ by it
// Model      a random walk: from what the level does beside its parabola follows what chance may do to the parabola, so
//            that a drift is named only where it is more than that
// At most    3 % in a minute as an estimate (twins draw about a lower one, not about this): friction that changes by
//            more does so for a reason, which is for the search to find
// Unit       share of the level per square root of a second (TwinLoop::friction_wander)
// None       no dry friction, or a recording too short for eight blocks
// Level      noise_level.hpp
// Threads    spreads twins over the threads and processes of `workers`; same bits for any number

#include <cstddef>
#include <vector>

#include "engine/twin/noise_level.hpp"

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

// the wander that the twin has already is not used
NoiseLevel friction_wander(ProcessedRecord const& recording, CleanTwin const& twin, RecordPipeline const& pipeline,
                           WanderReading reading, TwinAddress const& address, std::size_t twins,
                           TwinWorkers const& workers);

}  // namespace torquescope
