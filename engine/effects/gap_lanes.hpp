#pragma once
// Eight loads behind gaps side by side in vector registers, each with its own effect: what they do in one part of a
// step.
//
// Order      of a step: drive_to(), with dry friction speed_to(begins); for each part before_dry_sub_step(),
//            whole_sub_step(), after_dry_sub_step(), drive_on(); with dry friction speed_to(not begins)
// Bits       those of one load alone (load_behind_gap.hpp) on every instruction set
// Threads    functions of their arguments

#include <array>
#include <cstddef>

namespace torquescope::load_behind_gap {

inline constexpr std::size_t gap_lanes = 8;
using Eight = std::array<double, gap_lanes>;

// as the classes of load_behind_gap.hpp call what they have
struct EightGaps {
  Eight half_gap{};
  Eight square{}, push_per_s{}, decay{}, ringing{}, per_square{}, lag{}, per_ringing{};  // of the flank
  Eight film_push_per_s{}, per_film{};                                                   // of the grease
  Eight drag_per_s{};
  Eight forward{}, backward{}, is_dry{};  // dry friction
};

struct EightSubSteps {
  Eight count{}, time_s{}, cosine{}, sine{}, faded{}, is_thin{};
  double most = 1.0;  // of count
};

// of the motors, one each or one for all
struct Motions {
  double const *dq = nullptr, *ddq = nullptr;
  bool is_common = false;
};

struct EightLoads {
  Eight y{}, dy{}, side{};
  Eight weight{}, drive{};  // where the joint is
  Eight now{}, jerk{};      // what drives them in a step
  Eight event{};            // 1 where contact begins or ends, and nothing was changed
  // of those with dry friction: the joint's speed and what it gains in a part, the load's own direction, what drives
  // it, friction included, and where it was before the part
  Eight dq{}, faster{}, slides{}, pulled{}, y_before{};
};

// the joint comes to `at` within a step
void drive_to(EightGaps const& gaps, Motions const& at, double step_s, EightLoads& loads);
// the drive goes on for a part of it
void drive_on(EightSubSteps const& steps, EightLoads& loads);

// the speed of the joint at the end of a step, for loads with dry friction: what is gained on the way, or that it is
// there
void speed_to(EightSubSteps const& steps, Motions const& at, bool begins, EightLoads& loads);
// LoadBehindGap::dry_sub_step up to the sub-step itself, and after it
void before_dry_sub_step(EightGaps const& gaps, EightSubSteps const& steps, double part, EightLoads& loads);
void after_dry_sub_step(EightGaps const& gaps, EightSubSteps const& steps, double part, EightLoads& loads);

// the part of this number, of loads that have so many; whether there was any event. driven: as loads.now, or friction
// included
bool whole_sub_step(EightGaps const& gaps, EightSubSteps const& steps, double part, Eight const& driven,
                    EightLoads& loads);

// LoadBehindGap::push less what a load that is fixed to the motor would need there
void pull_of_loads(EightGaps const& gaps, EightLoads const& loads, Motions const& at, double* pull);

}  // namespace torquescope::load_behind_gap
