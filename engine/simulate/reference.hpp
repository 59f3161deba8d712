#pragma once
// The motion a joint is asked to make: position, velocity, acceleration as functions of time. One kind, one file in
// references/.
//
// Units      s, rad, rad/s, rad/s^2 (prismatic joint: m, m/s, m/s^2)
// Start      at rest at `centre`: position, velocity and (but for the trapezoid) acceleration are continuous from there
// Limits     oscillating kinds are scaled until the first of amplitude, max_speed, max_acceleration is reached
// Threads    const objects, any number of threads

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/base/random_stream.hpp"

namespace torquescope {

struct ReferencePoint {
  double q = 0.0, dq = 0.0, ddq = 0.0;
};

// points as columns of one length
struct ReferenceColumns {
  std::span<double> q, dq, ddq;

  std::size_t size() const { return q.size(); }
  void set(std::size_t i, ReferencePoint const& point) const {
    q[i] = point.q;
    dq[i] = point.dq;
    ddq[i] = point.ddq;
  }
};

class Reference {
 public:
  virtual ~Reference() = default;
  virtual ReferencePoint at(double time_s) const = 0;
  // of many times at once: the same bits, faster where a kind can
  virtual void at_each(std::span<double const> times_s, ReferenceColumns const& points) const;
};

struct ReferenceOptions {
  std::string kind = "multisine";
  double centre = 0.0;
  double amplitude = 2.0;           // CRS A465: within +-3.05 rad of joint 1
  double max_speed = 3.14;          // CRS A465, joints 1 to 3
  double max_acceleration = 12.57;  // the same source
  double ramp_s = 0.5;
  double base_hz = 0.1;
  std::vector<double> harmonics{};
  std::vector<double> frequencies_hz{};
  std::vector<double> band_hz{0.1, 1.0};
  std::vector<double> speeds{0.1, 0.3, 1.0, 3.0};
  double dwell_s = 0.1;
  std::string file{}, validate_file{};  // of an arm: a motion in place of all this

  static OptionTable<ReferenceOptions> const& table();
};

// names of all kinds, in the order of the CMake list
std::vector<std::string> const& reference_kinds();

// the frequencies of an oscillating kind: frequencies_hz, or harmonics of base_hz, or all multiples of base_hz in
// band_hz
std::vector<double> reference_frequencies_hz(ReferenceOptions const& options);

// what would make the reference senseless at this sampling rate: empty or reversed band, frequencies above half the
// rate, strokes longer than the recording, ...
void check_reference(ReferenceOptions const& options, double duration_s, double rate_hz, Section const& section,
                     std::vector<Problem>& problems);

// Requires   options that passed check_reference()
// Random     phases of the multisine: addressed by (key, NoiseStream::reference_phase, number of the frequency)
std::unique_ptr<Reference const> make_reference(ReferenceOptions const& options, double duration_s,
                                                RandomKey const& key);

}  // namespace torquescope
