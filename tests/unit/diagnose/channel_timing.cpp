// A torque channel that was read within half a sample of its row is put back in time; a longer delay is left as a finding.

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
  for (double late_s : {0.5e-3, -0.5e-3, 0.2e-3, -0.6e-3}) {
    Recording const earlier = with_torque_earlier(sine_read_late(late_s), late_s);
    // the first and the last sample have no neighbour on one side
    Eigen::Index const n = true_one.torque.size() - 2;
    double const curvature = 0.125 * std::pow(2.0 * M_PI * 3.0 * 1e-3, 2);
    EXPECT_LE((earlier.torque - true_one.torque).segment(1, n).cwiseAbs().maxCoeff(), 1.01 * curvature) << late_s;
    EXPECT_EQ(earlier.torque.size(), true_one.torque.size());
  }
}

TEST(ChannelTiming, SaysWhatWasDone) {
  EXPECT_EQ(timing_remark(0.5e-3, 1000.0).substr(0, 36), "torque taken 0.5 ms earlier than its");
  EXPECT_EQ(timing_remark(-0.5e-3, 1000.0).substr(0, 34), "torque taken 0.5 ms later than its");
}

}  // namespace
}  // namespace torquescope
