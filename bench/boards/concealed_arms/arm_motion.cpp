#include "concealed_arms/arm_motion.hpp"

#include <algorithm>
#include <cmath>

#include "concealed/noise.hpp"

namespace concealed_arms {
namespace {

constexpr double period_s = 10.0;
constexpr int harmonics = 5;
int ticks() { return static_cast<int>(std::lround(recorded_s / control_s)); }

ArmMotion still(int joints) {
  ArmMotion motion;
  motion.q = motion.v = motion.a = Eigen::MatrixXd::Zero(joints, ticks());
  return motion;
}

void sines_of_joint(ArmMotion& motion, int joint, Link const& link, concealed::Random& random) {
  double size[harmonics], phase[harmonics];
  for (int k = 0; k < harmonics; ++k) {
    size[k] = random.between(0.3, 1.0) / (k + 1);
    phase[k] = random.between(0.0, full_turn);
  }
  for (int tick = 0; tick < ticks(); ++tick) {
    for (int k = 0; k < harmonics; ++k) {
      double const w = full_turn * (k + 1) / period_s, angle = w * tick * control_s + phase[k];
      motion.q(joint, tick) += size[k] * std::sin(angle);
      motion.v(joint, tick) += size[k] * w * std::cos(angle);
      motion.a(joint, tick) -= size[k] * w * w * std::sin(angle);
    }
  }
  // as large as a drawn share of range, speed or acceleration allows
  double const low = motion.q.row(joint).minCoeff(), high = motion.q.row(joint).maxCoeff();
  double const share = random.between(0.6, 0.9), range = link.upper - link.lower;
  double const scale =
      share * std::min({range / (high - low), link.max_speed / motion.v.row(joint).cwiseAbs().maxCoeff(),
                        link.max_acceleration / motion.a.row(joint).cwiseAbs().maxCoeff()});
  double const room = range - scale * (high - low);
  double const centre = link.lower + random.between(0.1, 0.9) * room - scale * low;
  motion.q.row(joint) = (scale * motion.q.row(joint).array() + centre).matrix();
  motion.v.row(joint) *= scale;
  motion.a.row(joint) *= scale;
}

// a polynomial of the fifth degree: rest to rest, speeds up to 1.875 and accelerations up to 5.774 of the mean ones
void move(ArmMotion& motion, int begin, int length, Eigen::VectorXd const& from, Eigen::VectorXd const& to) {
  double const time = length * control_s;
  for (int tick = begin; tick < ticks(); ++tick) {
    double const s = std::min(1.0, (tick - begin) / static_cast<double>(length));
    motion.q.col(tick) = from + (to - from) * (s * s * s * (10.0 + s * (6.0 * s - 15.0)));
    motion.v.col(tick) = (to - from) * (30.0 * s * s * (1.0 - s) * (1.0 - s) / time);
    motion.a.col(tick) = (to - from) * (60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / (time * time));
  }
}

ArmMotion moves(Arm const& arm, concealed::Random& random) {
  ArmMotion motion = still(arm.joints());
  auto const pose = [&] {
    Eigen::VectorXd drawn(arm.joints());
    for (int j = 0; j < arm.joints(); ++j) {
      Link const& link = arm.links[static_cast<std::size_t>(j)];
      drawn[j] = link.lower + (link.upper - link.lower) * random.between(0.1, 0.9);
    }
    return drawn;
  };
  Eigen::VectorXd from = pose();
  for (int begin = 0; begin < ticks();) {
    Eigen::VectorXd const to = pose();
    double const share = random.between(0.3, 0.9);
    double seconds = 0.3;
    for (int j = 0; j < arm.joints(); ++j) {
      Link const& link = arm.links[static_cast<std::size_t>(j)];
      double const step = std::abs(to[j] - from[j]);
      seconds = std::max({seconds, 1.875 * step / (share * link.max_speed),
                          std::sqrt(5.774 * step / (share * link.max_acceleration))});
    }
    int const length = static_cast<int>(seconds / control_s);
    move(motion, begin, length, from, to);
    begin += length + static_cast<int>(random.between(0.0, 0.3) / control_s);
    from = to;
  }
  return motion;
}

}  // namespace

ArmMotion drawn_motion(MotionKind kind, Arm const& arm, std::uint64_t seed, std::string const& stream) {
  concealed::Random random(seed, "motion " + stream);
  if (kind == MotionKind::moves) return moves(arm, random);
  ArmMotion motion = still(arm.joints());
  for (int j = 0; j < arm.joints(); ++j) sines_of_joint(motion, j, arm.links[static_cast<std::size_t>(j)], random);
  return motion;
}

}  // namespace concealed_arms
