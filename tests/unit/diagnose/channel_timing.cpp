// A torque channel that was read beside its row is put back in time, whichever way and however far.

#include "engine/diagnose/channel_timing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace torquescope {
namespace {

Recording sine_read_late(double late_s) {
  Recording recording;
  recording.rate_hz = 1000.0;
  recording.time_s = Eigen::VectorXd::LinSpaced(2001, 0.0, 2.0);
  recording.torque = (2.0 * M_PI * 3.0 * (recording.time_s.array() - late_s)).sin();
  return recording;
}

TEST(ChannelTiming, PutsTheTorqueBackInTimeWhicheverWayItWasRead) {
  Recording const true_one = sine_read_late(0.0);
  for (double late_s : {0.5e-3, -0.5e-3, 0.2e-3, -0.6e-3, 1.0e-3, 1.3e-3, -2.1e-3}) {
    Recording const earlier = with_torque_earlier(sine_read_late(late_s), late_s);
    // the samples at the ends have no neighbour on one side
    constexpr Eigen::Index ends = 3;
    Eigen::Index const n = true_one.torque.size() - 2 * ends;
    double const curvature = 0.125 * std::pow(2.0 * M_PI * 3.0 * 1e-3, 2);
    EXPECT_LE((earlier.torque - true_one.torque).segment(ends, n).cwiseAbs().maxCoeff(), 1.01 * curvature) << late_s;
    EXPECT_EQ(earlier.torque.size(), true_one.torque.size());
  }
}

TEST(ChannelTiming, HoldsTheValueAtTheEnds) {
  Recording const read = sine_read_late(0.0);
  Recording const earlier = with_torque_earlier(read, 1.5e-3);
  EXPECT_EQ(earlier.torque.tail(1)[0], read.torque.tail(1)[0]);
  EXPECT_EQ(with_torque_earlier(read, -1.5e-3).torque[0], read.torque[0]);
}

TEST(ChannelTiming, SaysWhatWasDone) {
  EXPECT_EQ(timing_remark(0.5e-3, 1000.0).substr(0, 36), "torque taken 0.5 ms earlier than its");
  EXPECT_EQ(timing_remark(-0.5e-3, 1000.0).substr(0, 34), "torque taken 0.5 ms later than its");
}

}  // namespace
}  // namespace torquescope
