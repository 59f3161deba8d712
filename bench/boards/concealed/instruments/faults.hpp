#pragma once
// Makers of the instruments' faults, one file each. Forms marked (*) are deliberately not those of the engine's
// catalogue.
//
// Units      SI of the joint: N m, rad or N, m

#include "concealed/instrument.hpp"

namespace concealed {

using Fault = std::shared_ptr<Instrument const>;

// delay: the torque channel shows what was delay_s ago, on a straight line between its ticks
Fault late_torque(double delay_s, double tick_s);
// clipping (*): an unequal limit in each direction
Fault limited_torque(double lowest, double highest);
// sensor_drift (*): the zero settles like creep * (1 - exp(-t / settle_s)) and jumps by `jump` at jump_s
Fault creeping_zero(double creep, double settle_s, double jump, double jump_s);
// encoder_eccentricity (*): error e (sin x + 0.25 sin(2 x + 0.8)), x = q + phase; the disc also wobbles
Fault eccentric_disc(double error, double phase);

// no effects but decoys of measurement: a channel behind a filter of first order, and one refreshed every n-th tick
Fault filtered_torque(double cutoff_hz, double tick_s);
Fault held_torque(int n_ticks);

}  // namespace concealed
