#pragma once
// The spectrum of the torque noise where no controller separates it: a white part and a slow part with its corner.
//
// Model      white noise plus white noise through one pole (corner_hz), both added to the recorded torque only
// Equation   octave energies (octave_energies.hpp) of the recording = those of replicates without torque noise + those
//            of the two noises through the same filter and projection; non-negative; gamma likelihood, degrees of
//            freedom from draws of the noise; the slow part by Akaike's criterion
// Corner     from the cut-off to an octave below the lowest octave, in steps of half an octave
// Units      N m or N; Hz
// Threads    spreads replicates over the threads and processes of `workers`; same bits for any number
// Source     McCullagh, Nelder 1989, Generalized Linear Models, 8.3; Whittle 1953, doi:10.1007/BF02590998

#include <cstddef>
#include <string>

#include "engine/infer/pipeline/record_pipeline.hpp"
#include "engine/infer/replicates/twin_batch.hpp"

namespace torquescope {

struct TorqueColour {
  double white_std = 0.0;
  double slow_std = 0.0, corner_hz = 0.0;  // 0: no slow part
  double variance_error = 0.0;             // standard error of both variances, as a share: of the octave known worst
  // p-value of energies as far from this spectrum (deviance, chi squared): a line or a hump in the
  // spectrum is no memory of an amplifier
  double misfit_p = 1.0;
  bool ran_away = false;
};

// twins >= 8; what torque noise `twin` has is not used
TorqueColour torque_colour(ProcessedRecord const& recording, CleanTwin const& twin, RecordPipeline const& pipeline,
                           TwinAddress const& address, std::size_t twins, TwinWorkers const& workers);

// into a loop: the slow part goes beside the white one
void put_colour(TorqueColour const& colour, double rate_hz, TwinLoop& loop);

// for people
std::string colour_remark(TorqueColour const& colour, std::string const& unit);

}  // namespace torquescope
