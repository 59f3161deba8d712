#include "engine/data/motion.hpp"

namespace torquescope {

OptionTable<FilterOptions> const& FilterOptions::table() {
  using Options = FilterOptions;
  static OptionTable<Options> const table(
      "filter", "how the motion is smoothed and differentiated, and at which rate the fit works",
      {{"cutoff_hz", &Options::cutoff_hz, "Hz", 0.0, 1e6,
        "low-pass of the position before differentiation, zero phase (-6 dB there); 0: none"},
       {"order", &Options::order, "1", 1, 12,
        "Butterworth order of one pass; every filter runs forwards and backwards"},
       {"parallel_cutoff_hz", &Options::parallel_cutoff_hz, "Hz", 0.0, 1e6,
        "low-pass of the torque and every regressor column; 0: 0.4 * decimate_to_hz, or none"},
       {"decimate_to_hz", &Options::decimate_to_hz, "Hz", 0.0, 1e6,
        "rate kept for the fit; must divide the sampling rate; 0: keep it"},
       {"edge_s", &Options::edge_s, "s", -1.0, 1e3,
        "dropped at both ends of the recording; negative: three periods of the lowest cut-off"}});
  return table;
}

}  // namespace torquescope
