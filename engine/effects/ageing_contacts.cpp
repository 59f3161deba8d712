#include "engine/effects/ageing_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace torquescope {
namespace {

using Block = Eigen::Array<double, Eigen::Dynamic, 1, 0, states_at_once, 1>;

// share of what it aged that is left at the end of a step: (1 - e^-x) / x
Block share_left(Block const& renewed, Block const& decay) {
  constexpr double thin = 1e-3;  // below it the difference loses digits, and the next term of the series is below 1e-14
  Block const series = 1.0 - renewed * (1.0 / 2.0 - renewed * (1.0 / 6.0 - renewed / 24.0));
  return (renewed < thin).select(series, (1.0 - decay) / renewed);
}

// of each step, by the distance slid in it: the age becomes decay * age + gained_s
struct AgeingSteps {
  Block decay, gained_s;
  // rest_speeds, renewal_distances: one each
  AgeingSteps(Block const& ways, Block const& steps_s, Block const& rest_speeds, Block const& renewal_distances)
      : decay(-ways / renewal_distances) {
    Block const renewed = -decay;
    exponential(decay);
    // while it creeps the contact ages as far as it stands
    Block const rests = ways / (steps_s * rest_speeds);
    gained_s = share_left(renewed, decay) * (steps_s / (1.0 + rests * rests));
  }
};

// friction after some age, without its sign
struct Levels {
  double ended = 0.0;    // 1 - e^-(age / dwell)
  double endless = 0.0;  // ln(1 + age / dwell)
};

// as arrays
struct BlockLevels {
  Block ended, endless;
  // dwells: age / dwell
  explicit BlockLevels(Eigen::Ref<Eigen::ArrayXd const> const& dwells) : ended(-dwells), endless(1.0 + dwells) {
    exponential(ended);
    ended = 1.0 - ended;
    logarithm(endless);
  }
};

class AgeingContacts final : public EffectMemory {
 public:
  AgeingContacts(AgeingContact const& contact, std::size_t lanes) : contacts_(lanes, contact) {}

  void append(EffectMemory const& other) override {
    auto const& added = static_cast<AgeingContacts const&>(other).contacts_;
    contacts_.insert(contacts_.end(), added.begin(), added.end());
  }

  void columns(EffectInput const& input, Eigen::Ref<Eigen::MatrixXd> out) override {
    std::vector<std::size_t> left(contacts_.size());
    for (std::size_t lane = 0; lane < left.size(); ++lane) left[lane] = lane;
    while (!left.empty()) {
      AgeingContact const& first = contacts_[left.front()];
      auto const others = std::stable_partition(left.begin(), left.end(), [&](std::size_t lane) {
        return contacts_[lane].renewal_distance == first.renewal_distance &&
               contacts_[lane].rest_speed == first.rest_speed;
      });
      columns_of(std::vector<std::size_t>(left.begin(), others), input, out);
      left.erase(left.begin(), others);
    }
  }

  void advance(JointStates const& at, double step_s) override {
    if (q_.empty()) return start(at);
    Block ways(at.size()), rest_speeds(at.size()), renewal_distances(at.size()), dwells(at.size());
    for (Eigen::Index lane = 0; lane < at.size(); ++lane) {
      auto const i = static_cast<std::size_t>(lane);
      ways[lane] = std::abs(at.q[lane] - q_[i]);
      rest_speeds[lane] = contacts_[i].rest_speed;
      renewal_distances[lane] = contacts_[i].renewal_distance;
    }
    AgeingSteps const steps(ways, Block::Constant(at.size(), step_s), rest_speeds, renewal_distances);
    for (Eigen::Index lane = 0; lane < at.size(); ++lane) {
      auto const i = static_cast<std::size_t>(lane);
      ages_s_[i] = ages_s_[i] * steps.decay[lane] + steps.gained_s[lane];
      q_[i] = at.q[lane];
      dwells[lane] = ages_s_[i] / contacts_[i].dwell_s;
    }
    BlockLevels const levels(dwells);
    for (Eigen::Index lane = 0; lane < at.size(); ++lane)
      levels_[static_cast<std::size_t>(lane)] = {levels.ended[lane], levels.endless[lane]};
  }

  void torques(JointStates const& at, ParametersOfEach const& linear, std::span<double> out) const override {
    TORQUESCOPE_EXPECT(linear.cols() == 2 && out.size() == levels_.size());
    TORQUESCOPE_EXPECT(linear.rows() == static_cast<Eigen::Index>(out.size()));
    for (std::size_t i = 0; i < out.size(); ++i) {
      auto const lane = static_cast<Eigen::Index>(i);
      double const sign = contacts_[i].sign(at.dq[lane]);
      out[i] = linear(lane, 0) * (sign * levels_[i].ended) + linear(lane, 1) * (sign * levels_[i].endless);
    }
  }

 private:
  void start(JointStates const& at) {
    TORQUESCOPE_EXPECT(static_cast<std::size_t>(at.size()) == contacts_.size() && at.size() <= states_at_once);
    q_.assign(at.q.begin(), at.q.end());
    ages_s_.assign(q_.size(), 0.0);
    levels_.assign(q_.size(), {});
  }

  // of contacts that have the same age all the time, and of one joint
  void columns_of(std::vector<std::size_t> const& lanes, EffectInput const& input,
                  Eigen::Ref<Eigen::MatrixXd> out) const {
    Motion const& motion = input.motion;
    double age_s = 0.0;
    for (Eigen::Index from = 0; from < input.size(); from += states_at_once) {
      Eigen::Index const count = std::min(states_at_once, input.size() - from);
      Block const ages_s = ages_after(age_s, contacts_[lanes.front()], motion, from, count);
      age_s = ages_s[count - 1];
      Block const signs = motion.dq.segment(from, count).array().unaryExpr(contacts_[lanes.front()].sign);
      for (std::size_t const lane : lanes) {
        BlockLevels const levels(ages_s / contacts_[lane].dwell_s);
        auto const column = static_cast<Eigen::Index>(2 * lane);
        out.col(column).segment(from, count).array() = signs * levels.ended;
        out.col(column + 1).segment(from, count).array() = signs * levels.endless;
      }
    }
  }

  static Block ages_after(double age_s, AgeingContact const& contact, Motion const& motion, Eigen::Index from,
                          Eigen::Index count) {
    // the first sample is no step
    Eigen::Index const before = from > 0 ? 1 : 0, first = from + 1 - before, steps = count - 1 + before;
    Block ages_s(count);
    ages_s[0] = age_s;
    if (steps == 0) return ages_s;
    auto const change = [&](Eigen::VectorXd const& of) {
      return Block(of.segment(first, steps) - of.segment(first - 1, steps));
    };
    AgeingSteps const each(change(motion.q).abs(), change(motion.time_s), Block::Constant(steps, contact.rest_speed),
                           Block::Constant(steps, contact.renewal_distance));
    for (Eigen::Index i = 0; i < steps; ++i) {
      age_s = age_s * each.decay[i] + each.gained_s[i];
      ages_s[i + 1 - before] = age_s;
    }
    return ages_s;
  }

  std::vector<AgeingContact> contacts_;
  std::vector<double> q_, ages_s_;  // empty: not started
  std::vector<Levels> levels_;
};

}  // namespace

std::unique_ptr<EffectMemory> ageing_contacts(AgeingContact const& contact, std::size_t lanes) {
  return std::make_unique<AgeingContacts>(contact, lanes);
}

}  // namespace torquescope
