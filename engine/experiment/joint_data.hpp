#pragma once
// The data of a job of one joint: read, simulated or a set of servos', then filtered into the rows of its fit.
//
// Errors     65 and 66 of the recordings, 78 of keys that do not go with them
// Threads    free functions; each changes `parts` alone

#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/servo_job.hpp"
#include "engine/simulate/simulation_plan.hpp"

namespace torquescope {

// a diagnosis looks at the channels again, a fit only at its rows
enum class Channels { kept, taken };

void use_simulation(Experiment::Parts& parts, SimulationPlan const& plan, Channels channels);

void use_files(Experiment::Parts& parts, RecordingOptions const& options, RecordedTables const& tables,
               Channels channels);

// servos: least squares see what the joint itself took, simulations what is known of each recording
ServoJob use_recording_set(Experiment::Parts& parts);

// Of a job without [filter]: unfiltered, an encoder's steps differentiated twice drown the acceleration
void choose_filter(Experiment::Parts& parts);

// the rows of the fit, and what the motion can tell; excitation's warnings join those of the recording
void prepare(DataSet& set, Experiment::Parts const& parts, Channels channels);

}  // namespace torquescope
