#pragma once
// What an arm does to each of its joints as columns that come with the joint's recording, one a base parameter.
//
// Columns    y_j(q, dq, ddq) of row j of the arm, of every parameter that acts on the joint and is neither friction nor
//            an error of a gain: as the effect `rigid_rows` of Recording::given
// Beside     what stands for them in a decision about the joint alone: y_j times combinations of the parameters, less
//            the inertia that the joint has on average, which stays the joint's own; as the effect `rigid_arm`. None
//            that the joint's own inertia, speed, sign and offset, or those before, imitate
// Torque     whole, but for what is known of a payload: that passes the gear (Recording::gear_load)
// Shapes     n samples at the full rate, R_j columns, k combinations
// Errors     those of the filters
// Threads    free functions
// Source     Gautier, Khalil 1990, doi:10.1109/70.56655; Frisch, Waugh 1933, doi:10.2307/1907330

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/diagnose/arms/filtered_arm.hpp"

namespace torquescope {

inline constexpr char const* rigid_rows_name = "rigid_rows";
inline constexpr char const* rigid_arm_name = "rigid_arm";

// of joint j among the model's parameters, ascending
std::vector<Eigen::Index> rigid_parameters(ArmModel const& model, std::size_t joint);

// each joint of a recording with its rigid rows and the effects of its neighbours (arm_effects.hpp)
std::vector<Recording> joints_with_rigid_rows(ArmModel const& model, RecordedArm const& recording,
                                              ArmFilter const& filter);

// a term of a joint's model: the columns of that name. It passes the gear
std::unique_ptr<Effect const> rigid_term(char const* name, Eigen::Index columns);

// Adds the effect `rigid_arm` to all recordings of one joint, by the first `training` of them; how many columns it has:
// none that depends on those before it. combinations: R_j x c
Eigen::Index add_rigid_arm(std::vector<Recording>& recordings, std::size_t training,
                           Eigen::MatrixXd const& combinations, ArmFilter const& filter);

}  // namespace torquescope
