#pragma once
// An effect whose columns depend on the past: it runs a state over the motion, for identification and simulation alike.
// Files in effects/ add the state, a plain class:
//
//   void start(JointState const& state)
//   void advance(JointState const& state, double step_s)                     step_s > 0
//   std::array<double, L> row(JointState const& state) const                 torque per unit of each linear parameter
// Optional, for a memory that fades by an exponential of the way (many are computed at once):
//   double decay_exponent(double way) const                                  of a step of this way, with its sign
//   void advance(JointState const& state, double step_s, double decay)       decay = exp of it; replaces the other one
//
// Row        of the state last advanced to; a simulator may vary velocity and acceleration there, not place or time
// Lanes      replicates of a group go side by side, each with its own state; the class is looked up once for all
// Threads    an EffectMemory is used by one thread

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/effects/effect.hpp"
#include "engine/effects/joint_states.hpp"

namespace torquescope {

// the states behind the columns of one effect, one per lane: of one shape for replicates, of one shape each for columns
class EffectMemory {
 public:
  virtual ~EffectMemory() = default;
  // `other`, of the same effect and one lane as this, becomes the lane after the last
  virtual void append(EffectMemory const& other) = 0;
  // of lanes that start with the motion; out: input.size() x linear parameters of each lane.
  // A state waits for itself from sample to sample, so that several take hardly longer than one
  virtual void columns(EffectInput const& input, Eigen::Ref<Eigen::MatrixXd> out) = 0;
  // the lanes have come to `at`; they start with the first call
  virtual void advance(JointStates const& at, double step_s) = 0;
  // linear: of each lane
  virtual void torques(JointStates const& at, ParametersOfEach const& linear, std::span<double> out) const = 0;
};

class MemoryEffect : public Effect {
 public:
  using Effect::Effect;
  bool has_memory() const final { return true; }
  void columns(EffectInput const& input, std::span<double const> shape, Eigen::Ref<Eigen::MatrixXd> out) const override;
  void columns_of_shapes(EffectInput const& input, std::vector<std::vector<double>> const& shapes,
                         Eigen::Ref<Eigen::MatrixXd> out) const override;
  std::unique_ptr<EffectRunner> runner(std::span<double const> parameters, JointScales const& scales) const override;
  // of several joints with one shape
  virtual std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                               std::size_t lanes) const = 0;
};

// what a file in effects/ returns as memory(): `lanes` copies of a state that has not started
template <typename State>
std::unique_ptr<EffectMemory> memory_of(State const& fresh, std::size_t lanes) {
  constexpr bool decays = requires(State state, double way) { state.decay_exponent(way); };
  class Lanes final : public EffectMemory {
   public:
    Lanes(State const& fresh, std::size_t lanes) : states_(lanes, fresh) {}

    void append(EffectMemory const& other) override {
      auto const& added = static_cast<Lanes const&>(other).states_;
      states_.insert(states_.end(), added.begin(), added.end());
    }

    void columns(EffectInput const& input, Eigen::Ref<Eigen::MatrixXd> out) override {
      constexpr Eigen::Index together = 64;
      std::vector<double> remaining(decays ? states_.size() * together : 0);
      for (Eigen::Index first = 0; first < input.size(); first += together) {
        Eigen::Index const end = std::min(input.size(), first + together);
        auto const count = static_cast<std::size_t>(end - first);
        for (std::size_t lane = 0; decays && lane < states_.size(); ++lane)
          put_remaining(lane, input.motion.q, {remaining.data() + lane * together, count}, first);
        for (Eigen::Index i = first; i < end; ++i) {
          JointState const now = input.state(i);
          double const step_s = i == 0 ? 0.0 : input.motion.time_s[i] - input.motion.time_s[i - 1];
          Eigen::Index column = 0;
          for (std::size_t lane = 0; lane < states_.size(); ++lane) {
            if (i == 0)
              states_[lane].start(now);
            else
              go_on(lane, now, step_s, decays ? remaining[lane * together + static_cast<std::size_t>(i - first)] : 1.0);
            for (double const value : states_[lane].row(now)) out(i, column++) = value;
          }
        }
      }
    }

    void advance(JointStates const& at, double step_s) override {
      if (std::exchange(has_started_, true)) {
        if constexpr (decays) {
          for (std::size_t lane = 0; lane < states_.size(); ++lane)
            remaining_[lane] = states_[lane].decay_exponent(at.q[static_cast<Eigen::Index>(lane)] - q_[lane]);
          kernels::exponential(remaining_.data(), remaining_.size(), remaining_.data());
        }
        for (std::size_t lane = 0; lane < states_.size(); ++lane)
          go_on(lane, at.state(lane), step_s, decays ? remaining_[lane] : 1.0);
      } else {
        for (std::size_t lane = 0; lane < states_.size(); ++lane) states_[lane].start(at.state(lane));
        if constexpr (decays) remaining_.resize(states_.size());
      }
      if constexpr (decays) q_.assign(at.q.begin(), at.q.end());
    }

    void torques(JointStates const& at, ParametersOfEach const& linear, std::span<double> out) const override {
      using Row = decltype(states_.front().row(JointState{}));
      constexpr std::size_t width = std::tuple_size_v<Row>;
      TORQUESCOPE_EXPECT(linear.cols() == static_cast<Eigen::Index>(width) && out.size() == states_.size());
      TORQUESCOPE_EXPECT(linear.rows() == static_cast<Eigen::Index>(out.size()));
      for (std::size_t lane = 0; lane < states_.size(); ++lane) {
        Row const row = states_[lane].row(at.state(lane));
        double sum = 0.0;
        for (std::size_t k = 0; k < width; ++k)
          sum += linear(static_cast<Eigen::Index>(lane), static_cast<Eigen::Index>(k)) * row[k];
        out[lane] = sum;
      }
    }

   private:
    // factor by which a lane's memory fades in the step to each sample; remaining: of the samples from `from` on
    void put_remaining(std::size_t lane, Eigen::VectorXd const& q, std::span<double> remaining,
                       Eigen::Index from) const {
      if constexpr (decays) {
        for (std::size_t k = 0; k < remaining.size(); ++k) {
          Eigen::Index const i = from + static_cast<Eigen::Index>(k);
          remaining[k] = i > 0 ? states_[lane].decay_exponent(q[i] - q[i - 1]) : 0.0;
        }
        kernels::exponential(remaining.data(), remaining.size(), remaining.data());
      }
    }

    void go_on(std::size_t lane, JointState const& to, double step_s, [[maybe_unused]] double remaining) {
      if constexpr (decays)
        states_[lane].advance(to, step_s, remaining);
      else
        states_[lane].advance(to, step_s);
    }

    std::vector<State> states_;
    std::vector<double> q_, remaining_;  // of each lane: its position, and the factor of the coming step
    bool has_started_ = false;
  };
  return std::make_unique<Lanes>(fresh, lanes);
}

}  // namespace torquescope
