#include "sticking/drawn_case.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sticking {
namespace {

constexpr std::uint32_t most_attempts = 2000;
constexpr std::uint32_t attempts_of_a_size = 40;
constexpr double worst_tracking = 0.25, worst_chatter = 0.25;
constexpr double unknown_cutoff_hz = 5.0;  // of a job without a filter of its own
constexpr double closest_size = 0.15;      // relative distance from the wanted size that is close enough

// thirteen cases that follow each other have each of the thirteen effects once, in an order of their own
std::string effect_of(Address const& at) {
  auto names = effect_names();
  auto const n = static_cast<std::uint32_t>(names.size());
  Chance chance{{at.seed, at.number / n, at.kind, 0}, Purpose::order};
  for (std::size_t i = names.size() - 1; i > 0; --i) std::swap(names[i], names[chance.index(i + 1)]);
  return names[at.number % n];
}

Scale scale_of(Rig const& rig, std::vector<double> const& path, Recording const& recording) {
  auto const [low, high] = std::minmax_element(path.begin(), path.end());
  double speed = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
    speed = std::max(speed, std::abs(path[i] - path[i - 1]) * rig.control.rate_hz);
  double const highest_hz = rig.smoothing.is_there ? rig.smoothing.parallel_cutoff_hz : unknown_cutoff_hz;
  return {rig.joint, 0.5 * (*low + *high), *high - *low, speed, torque_rms(recording), highest_hz};
}

bool moves_as_asked(Recording const& recording) {
  return recording.tracking_error < worst_tracking && recording.chatter < worst_chatter;
}

class SizedEffect {
 public:
  SizedEffect(Rig const& rig, std::vector<double> const& path, HiddenEffect effect, double wanted)
      : rig_(rig), path_(path), effect_(std::move(effect)), wanted_(wanted) {}

  // The training recording with the effect in it; false where it cannot have that size
  bool fit(Recording const& without) { return effect_.name == "delay" ? fit_delay(without) : fit_amplitude(); }

  HiddenEffect effect() const { return effect_; }
  Recording train() { return std::move(train_); }
  double size() const { return size_; }

 private:
  bool fit_amplitude() {
    // the effect changes the motion on which its size is measured: twice is enough, or it is another draw
    double amplitude = 0.0;
    for (int round = 0; round < 3; ++round) {
      effect_.amplitude = amplitude;
      train_ = record(rig_, path_, &effect_);
      if (!moves_as_asked(train_)) return false;
      double const unit = relative_size(train_, &Mean::effect, rig_.joint.has_gravity);
      size_ = amplitude * unit;
      if (round > 0 && std::abs(size_ / wanted_ - 1.0) < 0.02) break;
      if (round < 2) amplitude = wanted_ / unit;
      if (!(amplitude <= effect_.largest)) return false;
    }
    return is_close();
  }

  bool fit_delay(Recording const& without) {
    auto const size_at = [&](double delay_s) {
      return relative_size(without, late_part(without, delay_s, rig_.reading.log_hz), rig_.joint.has_gravity);
    };
    double low = shortest_delay_s, high = longest_delay_s;
    if (size_at(low) > wanted_ || size_at(high) < wanted_) return false;
    while (high - low > 1.1 * step_s) {
      double const middle = step_s * std::round(0.5 * (low + high) / step_s);
      (size_at(middle) < wanted_ ? low : high) = middle;
    }
    effect_.amplitude = effect_.delay_s = low;
    train_ = record(rig_, path_, &effect_);
    size_ = size_at(low);
    return is_close();
  }

  bool is_close() const {
    return std::abs(size_ / wanted_ - 1.0) < closest_size && size_ >= smallest_size && size_ <= largest_size;
  }

  Rig const& rig_;
  std::vector<double> const& path_;
  HiddenEffect effect_;
  Recording train_;
  double wanted_, size_ = 0.0;
};

// a machine nearby goes on between the recordings
HiddenEffect in_other_recording(HiddenEffect const& effect, Address const& at) {
  if (effect.name != "periodic_disturbance") return effect;
  HiddenEffect other = effect;
  double const later_s = Chance{at, Purpose::pause}.between(50.0, 300.0);
  other.torque = [torque = effect.torque, later_s](Moment now) {
    now.t += later_s;
    return torque(now);
  };
  return other;
}

bool attempt(Case& drawn, std::string const& name, double wanted) {
  Address const& at = drawn.at;
  drawn.rig = draw_rig(at, needs_gravity(name));
  Rig const& rig = drawn.rig;
  auto const path = draw_motion(rig.limits, rig.control.rate_hz, Chance{at, Purpose::train_motion}, false);
  auto const other = draw_motion(rig.limits, rig.control.rate_hz, Chance{at, Purpose::other_motion}, true);
  drawn.train = record(rig, path, nullptr);
  if (!moves_as_asked(drawn.train)) return false;
  std::optional<HiddenEffect> later;
  if (!name.empty()) {
    Scale const scale = scale_of(rig, path, drawn.train);
    Chance chance{at, Purpose::effect};
    SizedEffect sized{rig, path, draw_effect(name, scale, chance), wanted};
    if (!sized.fit(drawn.train)) return false;
    drawn.effect = sized.effect();
    drawn.effect_size = sized.size();
    drawn.train = sized.train();
    later = in_other_recording(*drawn.effect, at);
  }
  drawn.other = record(rig, other, later ? &*later : nullptr);
  return moves_as_asked(drawn.other);
}

}  // namespace

Case draw_case(std::uint64_t seed, std::uint32_t number, std::string const& kind) {
  if (kind != "clean" && kind != "single") throw std::invalid_argument("no kind is called " + kind);
  Case drawn;
  drawn.at = {seed, number, kind == "clean" ? 0U : 1U, 0};
  std::string const name = kind == "clean" ? "" : effect_of(drawn.at);
  double wanted = 0.0;
  for (std::uint32_t n = 0; n < most_attempts; ++n) {
    drawn.at.attempt = n;
    // a size stays wanted for many joints, or small ones would be found more often than they are drawn
    if (n % attempts_of_a_size == 0) wanted = Chance{drawn.at, Purpose::size}.log_between(smallest_size, largest_size);
    if (!attempt(drawn, name, wanted)) continue;
    bool const has_gravity = drawn.rig.joint.has_gravity;
    drawn.torque_rms = torque_rms(drawn.train);
    drawn.sticking_size = relative_size(drawn.train, &Mean::sticking, has_gravity);
    if (drawn.rig.reading.commanded) drawn.lag_size = relative_size(drawn.train, &Mean::lag, has_gravity);
    return drawn;
  }
  throw std::runtime_error("no joint of " + std::to_string(most_attempts) + " takes the effect " + name);
}

}  // namespace sticking
