#pragma once
// The noise of the torque where no controller tells it: how much of it is white, how much slow, and how slow.
//
// Without a reference nobody knows what the motor was told, so noise can only be read from what the model leaves; nor
// does a law tell it that is only a rougher copy of a controller (a drive that is faster than its log), nor what acts
// on the joint from outside and has a memory. A torque channel whose noise has one (amplifiers, filters, friction of
// bearings) is louder at a few hertz than its white part lets expect, and twins with white noise alone would take all
// of that for missing physics.
//
// Model      white noise plus white noise through one pole (corner_hz), both only logged
// Statistic  energies in the octaves below the filter's cut-off (octave_energies.hpp)
// Fit        energies of the recording = those of twins without torque noise + of the two noises through the same
//            filter and projection; gamma likelihood, its degrees of freedom from the noise's own draws; the slow part
//            is taken in when Akaike's criterion asks for it. Non-negative
// Corner     from the cut-off to an octave below the lowest one, in steps of half an octave
// Units      N m or N; Hz
// Threads    spreads twins over the threads and processes of `workers`; same bits for any number
// Source     McCullagh, Nelder 1989, 8.3 (gamma likelihood of spectral estimates: Whittle 1953)

#include <cstddef>
#include <string>

#include "engine/pipeline/record_pipeline.hpp"
#include "engine/twin/twin_batch.hpp"

namespace torquescope {

struct TorqueColour {
  double white_std = 0.0;
  double slow_std = 0.0, corner_hz = 0.0;  // 0: no slow part
  double variance_error = 0.0;             // standard error of both variances, as a share: of the octave known worst
  // chance that noise of this colour has energies so unlike its own (deviance, chi squared): a line or a hump in the
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
