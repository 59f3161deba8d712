#include "engine/effects/loads_behind_gap.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/effects/gap_lanes.hpp"
#include "kernels/elementary.hpp"

namespace torquescope::load_behind_gap {
namespace {

class LoadsBehindGap final : public EffectMemory {
 public:
  LoadsBehindGap(LoadBehindGap const& fresh, std::size_t lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) add(fresh);
  }

  void append(EffectMemory const& other) override {
    for (LoadBehindGap const& fresh : static_cast<LoadsBehindGap const&>(other).loads_) add(fresh);
  }

  void columns(EffectInput const& input, Eigen::Ref<Eigen::MatrixXd> out) override {
    std::vector<double> const weights = weights_on(input.motion.q);
    Eight pull{};
    for (Eigen::Index i = 0; i < input.size(); ++i) {
      Motions const at{&input.motion.dq[i], &input.motion.ddq[i], true};
      for (std::size_t block = 0; block < blocks_.size(); ++block) {
        auto& [gaps, loads, has_dry] = blocks_[block];
        if (i > 0) {
          if (!weights.empty()) loads.weight.fill(weights[static_cast<std::size_t>(i)]);
          follow(block, at, input.motion.time_s[i] - input.motion.time_s[i - 1]);
        } else {
          start(block, [&](std::size_t) { return input.state(0); });
        }
        pull_of_loads(gaps, loads, at, pull.data());
        for (std::size_t k = 0; k < lanes_of(block); ++k)
          out(i, static_cast<Eigen::Index>(block * gap_lanes + k)) = pull[k];
      }
    }
  }

  void advance(JointStates const& at, double step_s) override {
    bool const has_started = std::exchange(has_started_, true);
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      if (has_started) {
        Room room;
        weigh(block, at);
        follow(block, motions(at, block, room), step_s);
      } else {
        start(block, [&](std::size_t lane) { return at.state(lane); });
      }
    }
  }

  void torques(JointStates const& at, ParametersOfEach const& linear, std::span<double> out) const override {
    TORQUESCOPE_EXPECT(linear.cols() == 1 && out.size() == loads_.size());
    TORQUESCOPE_EXPECT(linear.rows() == static_cast<Eigen::Index>(out.size()));
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      Room room;
      Eight pull;
      auto const& [gaps, loads, has_dry] = blocks_[block];
      pull_of_loads(gaps, loads, motions(at, block, room), pull.data());
      for (std::size_t k = 0; k < lanes_of(block); ++k) {
        std::size_t const lane = block * gap_lanes + k;
        out[lane] = 0.0 + linear(static_cast<Eigen::Index>(lane), 0) * pull[k];
      }
    }
  }

 private:
  // lanes behind the last load are never in a gap and never meet a flank
  struct Block {
    EightGaps gaps{};
    EightLoads loads{};
    bool has_dry = false;
  };
  // for motions of a block that is not full
  struct Room {
    Eight dq, ddq;
  };

  void add(LoadBehindGap const& fresh) {
    std::size_t const k = loads_.size() % gap_lanes;
    loads_.push_back(fresh);
    if (k == 0) blocks_.emplace_back();
    EightGaps& gaps = blocks_.back().gaps;
    Flank const& flank = fresh.flank();
    gaps.half_gap[k] = fresh.half_gap();
    gaps.square[k] = flank.omega() * flank.omega();
    gaps.push_per_s[k] = flank.push_per_s();
    gaps.decay[k] = flank.decay();
    gaps.ringing[k] = flank.ringing();
    gaps.per_square[k] = flank.per_square();
    gaps.lag[k] = flank.lag();
    gaps.per_ringing[k] = flank.per_ringing();
    gaps.film_push_per_s[k] = fresh.grease().push_per_s();
    gaps.per_film[k] = fresh.grease().per_film();
    gaps.drag_per_s[k] = fresh.drag_per_s();
    gaps.forward[k] = fresh.dry().forward;
    gaps.backward[k] = fresh.dry().backward;
    gaps.is_dry[k] = fresh.dry().is_there() ? 1.0 : 0.0;
    blocks_.back().has_dry = blocks_.back().has_dry || fresh.dry().is_there();
  }

  std::size_t lanes_of(std::size_t block) const { return std::min(gap_lanes, loads_.size() - block * gap_lanes); }

  Motions motions(JointStates const& at, std::size_t block, Room& room) const {
    std::size_t const first = block * gap_lanes, lanes = lanes_of(block);
    if (lanes == gap_lanes) return {at.dq.data() + first, at.ddq.data() + first};
    room.dq.fill(0.0);
    room.ddq.fill(0.0);
    std::copy_n(at.dq.data() + first, lanes, room.dq.begin());
    std::copy_n(at.ddq.data() + first, lanes, room.ddq.begin());
    return {room.dq.data(), room.ddq.data()};
  }

  // what all loads of one motion weigh; empty: nothing
  std::vector<double> weights_on(Eigen::VectorXd const& q) const {
    LoadBehindGap const& any = loads_.front();
    if (!any.has_weight()) return {};
    auto const n = static_cast<std::size_t>(q.size());
    std::vector<double> weights(n), cosine(n), sine(n);
    kernels::cosine_sine_of_multiple(1.0, q.data(), n, cosine.data(), sine.data());
    for (std::size_t i = 0; i < n; ++i) weights[i] = any.weight(cosine[i], sine[i]);
    return weights;
  }

  void weigh(std::size_t block, JointStates const& at) {
    LoadBehindGap const& any = loads_.front();
    if (!any.has_weight()) return;
    Eight cosine, sine;
    std::size_t const lanes = lanes_of(block);
    kernels::cosine_sine_of_multiple(1.0, at.q.data() + block * gap_lanes, lanes, cosine.data(), sine.data());
    for (std::size_t k = 0; k < lanes; ++k) blocks_[block].loads.weight[k] = any.weight(cosine[k], sine[k]);
  }

  template <typename StateOf>
  void start(std::size_t block, StateOf const& state_of) {
    for (std::size_t k = 0; k < lanes_of(block); ++k) {
      LoadBehindGap& load = loads_[block * gap_lanes + k];
      load.start(state_of(block * gap_lanes + k));
      take(block, k);
      blocks_[block].loads.weight[k] = load.load().weight;
      blocks_[block].loads.drive[k] = load.load().drive;
      blocks_[block].loads.dq[k] = load.load().dq;
      blocks_[block].loads.slides[k] = load.load().slides;
    }
  }

  // weights are known
  void follow(std::size_t block, Motions const& at, double step_s) {
    auto& [gaps, loads, has_dry] = blocks_[block];
    EightSubSteps const& steps = sub_steps_in(step_s)[block];
    drive_to(gaps, at, step_s, loads);
    if (has_dry) speed_to(steps, at, true, loads);
    Eight const& driven = has_dry ? loads.pulled : loads.now;
    for (double part = 0.0; part < steps.most; part += 1.0) {
      if (has_dry) before_dry_sub_step(gaps, steps, part, loads);
      if (whole_sub_step(gaps, steps, part, driven, loads)) meet_events(block, driven, step_s);
      if (has_dry) after_dry_sub_step(gaps, steps, part, loads);
      drive_on(steps, loads);
    }
    if (has_dry) speed_to(steps, at, false, loads);
  }

  std::vector<EightSubSteps> const& sub_steps_in(double step_s) {
    return remembered_.of(step_s, [this](double whole_s) {
      std::vector<EightSubSteps> steps(blocks_.size());
      for (auto& one : steps) one.is_thin.fill(1.0);
      for (std::size_t lane = 0; lane < loads_.size(); ++lane) {
        loads_[lane].divide(whole_s);
        GapSubSteps const& own = loads_[lane].sub_steps();
        EightSubSteps& all = steps[lane / gap_lanes];
        std::size_t const k = lane % gap_lanes;
        all.count[k] = own.count;
        all.time_s[k] = own.time_s;
        all.cosine[k] = own.fading.cosine;
        all.sine[k] = own.fading.sine;
        all.faded[k] = own.faded;
        all.is_thin[k] = loads_[lane].grease().is_thin(own.time_s) ? 1.0 : 0.0;
        all.most = std::max(all.most, all.count[k]);
      }
      return steps;
    });
  }

  // one load after the other: few at a time meet a flank
  void meet_events(std::size_t block, Eight const& driven, double step_s) {
    EightLoads const& loads = blocks_[block].loads;
    for (std::size_t k = 0; k < lanes_of(block); ++k) {
      if (loads.event[k] == 0.0) continue;
      LoadBehindGap& load = loads_[block * gap_lanes + k];
      load.divide(step_s);
      load.put({{loads.y[k], loads.dy[k]}, loads.side[k], loads.weight[k], loads.drive[k]});
      load.sub_step({driven[k], loads.jerk[k]});
      take(block, k);
    }
  }

  void take(std::size_t block, std::size_t k) {
    LoadState const& load = loads_[block * gap_lanes + k].load();
    EightLoads& loads = blocks_[block].loads;
    loads.y[k] = load.at.y;
    loads.dy[k] = load.at.dy;
    loads.side[k] = load.side;
  }

  std::vector<LoadBehindGap> loads_{};  // one per lane: its effect, and what one event needs
  std::vector<Block> blocks_{};
  RememberedSteps<std::vector<EightSubSteps>> remembered_{};
  bool has_started_ = false;
};

}  // namespace

std::unique_ptr<EffectMemory> loads_behind_gap(LoadBehindGap const& fresh, std::size_t lanes) {
  return std::make_unique<LoadsBehindGap>(fresh, lanes);
}

}  // namespace torquescope::load_behind_gap
