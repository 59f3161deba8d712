#pragma once
// What the next start of an evolution strategy looks like: how many samples a generation, and how wide it begins.
//
// same       as the first start
// ipop       twice the samples of the start before
// bipop      two kinds in turn, whichever has spent fewer evaluations: large, as ipop; small, with 2^((k - 1) U^2)
//            times the first samples and 10^(-2 V) times the first width, k doublings of the large kind, U and V
//            uniform. A small one ends with half the evaluations of the last large one. The first counts for neither
// Samples    whole multiples of the first start's, at most 2^9 times: the sources' nine doublings
// Source     Auger, Hansen 2005, doi:10.1109/CEC.2005.1554902; Hansen 2009, doi:10.1145/1570256.1570333

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/random_stream.hpp"

namespace torquescope {

enum class Restarts { ipop, bipop, same };
std::vector<std::string> const& restart_words();

class RestartPlan {
 public:
  explicit RestartPlan(Restarts kind) : kind_(kind) {}

  // of the current start, as multiples of the first one's
  std::size_t samples() const { return static_cast<std::size_t>(now_.samples); }
  double width() const { return now_.width; }

  void count(std::int64_t evaluations) { now_.spent += static_cast<double>(evaluations); }
  // a small start has had its share
  bool is_spent() const { return now_.is_small != 0.0 && now_.spent >= 0.5 * now_.last_large; }
  // two draws of `random`
  void begin_next(RandomStream& random);

  static constexpr std::size_t n_numbers = 8;
  std::array<double, n_numbers> numbers() const;
  static bool accepts(std::span<double const> numbers);
  void restore(std::span<double const> numbers);

 private:
  // whole numbers but the width, as doubles hold them exactly
  struct State {
    double samples = 1.0, width = 1.0, is_small = 0.0;
    double doublings = 0.0;   // of the large kind
    double spent = 0.0;       // evaluations of this start
    double last_large = 0.0;  // of the large start before this
    double large = 0.0, small = 0.0;
  };

  Restarts kind_;
  State now_;
};

}  // namespace torquescope
