#pragma once
// What became of every sample of a recording: used by a fit, or left out because of what.
//
// Equation   read = used + sum of the parts
// Order      a sample that several reasons leave out counts with the first: the filter's edges, the stretches in their
//            order (with the filter's reach around them), then what the caller adds
// Units      samples of the recording; after a decimation each kept one stands for as many as were read
// Threads    free functions

#include <string>
#include <vector>

#include "engine/data/motion.hpp"

namespace torquescope {

struct RowAccount {
  enum class Why { edge, asked_for, no_rows, no_value, turns };
  struct Part {
    Why why = Why::edge;
    std::string column{};  // of the channel without a value
    double samples = 0.0;
  };
  std::string joint{};  // of an arm: its title
  double read = 0.0;
  std::vector<Part> parts{};

  double left_out() const;
  double used() const { return read - left_out(); }
};

// per kept sample of the filter: the stretch that leaves it out, counted from 0, or -1
// n_samples, rate_hz: of the recording
std::vector<int> stretch_of_samples(std::vector<LeftOutStretch> const& because, Eigen::Index n_samples, double rate_hz,
                                    ParallelFilter const& filter, double cutoff_hz);

// stretch: as above; turns: per kept sample, whether it is left out as one near a turn or a rest; empty: none
RowAccount row_account(std::vector<LeftOutStretch> const& because, std::vector<int> const& stretch,
                       std::vector<bool> const& turns, Eigen::Index n_samples, ParallelFilter const& filter);

// "12000 samples = 11400 used (95.0 %) + 360 (3.0 %) without a value of "q3" + 240 (2.0 %) at the filter's ends"
std::string account_words(RowAccount const& account);

}  // namespace torquescope
