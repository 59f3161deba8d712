#include "concealed/closed_loop.hpp"

#include <algorithm>
#include <cmath>

#include "concealed/noise.hpp"
#include "concealed/seen_signals.hpp"
#include "concealed/sensors.hpp"

namespace concealed {
namespace {

// everything random about one run
struct Noises {
  Noises(Rig const& rig, std::uint64_t seed)
      : level(rig.noise),
        scale(rig.joint.baseline.coulomb),
        white(seed, "white"),
        coloured(Random(seed, "coloured"), level.coloured * scale, 0.008, tick_s),
        disturbance(Random(seed, "disturbance"), level.disturbance * scale, 0.03, tick_s),
        wander(Random(seed, "wander"), level.friction_wander, 20.0, tick_s),
        jitter(seed, "jitter"),
        last_bits(seed, "last bits") {}

  double current() { return level.white * scale * white.normal() + coloured.next(); }
  double clock() { return level.clock_jitter * tick_s * jitter.normal(); }

  NoiseLevel level;
  double scale;
  Random white;
  ColouredNoise coloured, disturbance, wander;
  Random jitter, last_bits;
};

void record_middle(Truth& truth, Plant const& plant, SeenSignals const& signals, State const& state,
                   Drive const& drive) {
  truth.t.push_back(state.t);
  truth.q.push_back(state.q());
  truth.v.push_back(state.v());
  truth.a.push_back(plant.acceleration(state, drive));
  SeenSignals::Motion const moved{truth.q.back(), truth.v.back(), truth.a.back()}, seen = signals.motion(moved);
  truth.seen_q.push_back(seen.q);
  truth.seen_v.push_back(seen.v);
  truth.seen_a.push_back(seen.a);
  truth.motor.push_back(drive.motor);
  truth.disturbance.push_back(drive.disturbance);
  truth.coulomb_factor.push_back(drive.coulomb_factor);
  for (std::size_t i = 0; i < plant.n_effects(); ++i) {
    truth.added[i].push_back(plant.added_torque(i, state, drive));
  }
  for (std::size_t i = plant.n_effects(); i < truth.added.size(); ++i) {
    truth.added[i].push_back(signals.faked(i - plant.n_effects(), plant.baseline(), moved));
  }
}

}  // namespace

Rig without_noise(Rig rig) {
  rig.noise = noise_named("none");
  rig.encoder_bits = 0;
  rig.noisy_bits = 0;
  return rig;
}

LoopRun run_closed_loop(Rig const& rig, HiddenEffects const& effects, RunPlan const& plan) {
  JointDesign const& joint = rig.joint;
  Plant const plant(joint.baseline, effects);
  Controller controller(rig.controller, joint.baseline.inertia, joint.torque_limit, tick_s);
  Encoder const encoder =
      rig.encoder_bits > 0 ? Encoder::per_turn(rig.encoder_bits, joint.travel_per_turn) : Encoder::ideal();
  Converter const converter(rig.noise.converter_bits, joint.torque_limit);
  Noises noises(rig, plan.seed);
  SeenSignals signals(rig.instruments);
  double const lost = rig.noisy_bits > 0 ? encoder.step() * std::exp2(rig.noisy_bits) : 0.0;

  LoopRun run;
  run.truth.added.resize(effects.size() + rig.instruments.size());
  State state = plant.at_rest(plan.excitation.position(0.0));
  double pending = 0.0;
  double const slowest = slowest_share * joint.limits.speed;
  auto const n_ticks = static_cast<long>(std::llround(plan.duration_s / tick_s));
  for (long k = 0; k < n_ticks; ++k) {
    // the tick begins
    double const nominal = static_cast<double>(k) * tick_s;
    double const blur = lost > 0.0 ? lost * noises.last_bits.between(-0.5, 0.5) : 0.0;
    double const reading = encoder.read(signals.position(state.q()) + blur);
    double const reference = plan.excitation.position(nominal);
    Drive const drive{pending, noises.disturbance.next(), 1.0 + noises.wander.next()};
    run.truth.seen_motor.push_back(signals.torque(state.t, drive.motor));
    run.recording.time.push_back(rig.nominal_stamps ? nominal : state.t);
    run.recording.reference.push_back(reference);
    run.recording.position.push_back(reading);
    run.recording.torque.push_back(converter.read(run.truth.seen_motor.back() + noises.current()));
    pending = controller.command(reference, reading);

    // the plant moves on to the next tick
    double const length = nominal + tick_s + noises.clock() - state.t;
    auto const half_steps = static_cast<int>(std::ceil(0.5 * length / plan.step_s - 1e-9));
    double const step = 0.5 * length / half_steps;
    double const v_before = state.v();
    for (int i = 0; i < half_steps; ++i) plant.advance(state, drive, step);
    record_middle(run.truth, plant, signals, state, drive);
    double const v_middle = state.v();
    for (int i = 0; i < half_steps; ++i) plant.advance(state, drive, step);
    double const direction = v_middle > 0.0 ? 1.0 : -1.0;
    run.truth.moves.push_back(std::min({direction * v_before, direction * v_middle, direction * state.v()}) >= slowest);
  }
  return run;
}

}  // namespace concealed
