#include "servo/recording.hpp"

#include <cmath>
#include <cstddef>

#include "servo/drive.hpp"
#include "servo/joint.hpp"

namespace servo {
namespace {

constexpr double settling_s = 3.0;

long steps_of(double time) { return std::lround(time / step_s); }

}  // namespace

Recording record(ServoNumbers const& servo, Setting const& setting, std::vector<Sample> const& samples) {
  Joint joint{servo, setting};
  Drive drive{servo, setting, samples.front().goal};
  long const delay = steps_of(servo.command_delay_s);
  std::size_t next = 0;     // sample to be recorded
  std::size_t arrived = 0;  // sample whose goal the drive has
  Recording made;
  for (long step = -steps_of(settling_s); next < samples.size(); ++step) {
    if (step == steps_of(samples[next].time)) {
      made.read.push_back(joint.read());
      made.position.push_back(joint.position());
      ++next;
    }
    while (arrived + 1 < samples.size() && steps_of(samples[arrived + 1].time) + delay <= step) ++arrived;
    if (step % steps_per_tick == 0) drive.tick(samples[arrived].goal, joint.read());
    // the switch of the drive is not delayed
    bool const is_on = next == 0 || samples[next - 1].is_on;
    joint.step(drive.step(is_on), is_on);
  }
  return made;
}

}  // namespace servo
