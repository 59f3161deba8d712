#include "engine/workflows/results/servo_code.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/simulate/rollout/loop_form.hpp"

namespace torquescope {
namespace {

struct ServoModel {
  std::string name, headline;
  std::map<std::string, double> numbers;  // as [loop] and [model.given] call them

  double operator[](char const* key) const {
    if (auto const own = numbers.find(key); own != numbers.end()) return own->second;
    auto const of_loop = loop_key_of(key);
    return of_loop ? facts_of(*of_loop).none : 0.0;
  }
};

ServoModel model_of(std::string const& text) {
  ServoModel model;
  auto const document = nlohmann::ordered_json::parse(text, nullptr, false);
  bool is_whole = document.is_object() && document.contains("parameters") && document["parameters"].is_array();
  if (is_whole) {
    model.name = document.value("name", "");
    model.headline = document.value("headline", "");
    for (auto const& one : document["parameters"]) {
      is_whole = is_whole && one.contains("name") && one.contains("value") && one["value"].is_number();
      if (is_whole) model.numbers[one["name"].get<std::string>()] = one["value"].get<double>();
    }
  }
  if (is_whole && document.contains("given"))
    for (auto const& [name, value] : document["given"].items())
      if (value.is_number()) model.numbers.emplace(name, value.get<double>());
  validate(is_whole, [] {
    return Problem{.code = ExitCode::bad_data,
                   .what = "the result holds no parameters of a servo",
                   .help = "diagnose its job again"};
  });
  return model;
}

// a comment cannot end itself
std::string remark(std::string text) {
  for (std::size_t at = text.find("*/"); at != std::string::npos; at = text.find("*/")) text.replace(at, 2, "* /");
  for (char& letter : text)
    if (static_cast<unsigned char>(letter) < ' ') letter = ' ';
  return text;
}

constexpr char const* numbers_in_c = R"(#include <math.h>

enum {{ servo_delays = 256 }}; /* ticks that a delay may last */

/* what is known of one recording */
typedef struct {{
  double gravity_moment; /* N m, of sin(q); q = 0 hangs down */
  double inertia;        /* kg m2, of the load */
  double command_gain;   /* command per rad of error */
  double command_limit;  /* of the command */
  double arm_length;     /* m, of the arm whose mass was fitted; else 0 */
}} servo_known;

typedef struct {{
  double q, dq;              /* rad, rad/s */
  double goal, goal_speed;   /* as led by the drive */
  double lagged;             /* command behind its lag */
  double goals[servo_delays];
  int tick;
}} servo_state;

static const double inertia = {inertia:.17g}, viscous = {viscous:.17g};
static const double coulomb = {coulomb:.17g}, offset = {offset:.17g};
static const double motor_gain = {motor_gain:.17g}, back_emf = {back_emf:.17g};
static const double command_delay_s = {command_delay_s:.17g}, torque_lag_s = {torque_lag_s:.17g};
static const double goal_speed_limit = {goal_speed_limit}, goal_acceleration_limit = {goal_acceleration_limit};
static const double dead_band = {dead_band:.17g}, punch = {punch:.17g}, torque_limit = {torque_limit};
static const double load_friction = {load_friction:.17g}, load_square_friction = {load_square_friction:.17g};
static const double stribeck_friction = {stribeck_friction:.17g}, stribeck_speed = {stribeck_speed:.17g};
static const double load_stribeck_friction = {load_stribeck_friction:.17g};
static const double load_motor_share = {load_motor_share:.17g}, arm_mass = {arm_mass:.17g};
static const double angle_friction_cos = {angle_friction_cos:.17g}, angle_friction_sin = {angle_friction_sin:.17g};
)";

constexpr char const* step_in_c = R"(
static double servo_clamp(double value, double most) { return value > most ? most : value < -most ? -most : value; }

void servo_start(servo_state *s, double q, double goal) {
  s->q = q;
  s->dq = s->goal_speed = s->lagged = 0.0;
  s->goal = goal;
  s->tick = 0;
  for (int k = 0; k < servo_delays; ++k) s->goals[k] = goal;
}

/* the goal command_delay_s ago, led by what the drive allows: it brakes so as to arrive */
static double servo_led(servo_state *s, double goal, double dt) {
  double late = command_delay_s / dt;
  if (late > servo_delays - 2) late = servo_delays - 2;
  int whole = (int)late;
  s->goals[s->tick % servo_delays] = goal;
  double newer = s->goals[(s->tick + servo_delays - whole) % servo_delays];
  double older = s->goals[(s->tick + servo_delays - whole - 1) % servo_delays];
  double way = newer + (late - whole) * (older - newer) - s->goal;
  double step = fmin(fabs(way), goal_speed_limit * dt), change = goal_acceleration_limit * dt * dt;
  ++s->tick;
  if (isinf(change)) return s->goal += way < 0.0 ? -step : step;
  step = fmin(step, change * (sqrt(2.0 * fabs(way) / change + 0.25) - 0.5));
  step = way < 0.0 ? -step : step;
  step = fmax(s->goal_speed - change, fmin(s->goal_speed + change, step));
  s->goal_speed = step;
  return s->goal += step;
}

/* dt on, at most 2 ms; read: the position that the drive's encoder shows, else s->q */
void servo_step(servo_state *s, servo_known const *k, double goal, double read, int is_on, double dt) {
  double error = servo_led(s, goal, dt) - read, command = k->command_gain * error;
  if (fabs(error) <= dead_band || command == 0.0)
    command = 0.0;
  else if (fabs(command) < punch)
    command = command < 0.0 ? -punch : punch;
  command = is_on ? servo_clamp(command, fmin(torque_limit, k->command_limit)) : 0.0;
  if (torque_lag_s > 0.0) command = s->lagged = is_on ? command + (s->lagged - command) * exp(-dt / torque_lag_s) : 0.0;
  double motor = motor_gain * command - (is_on ? back_emf * s->dq : 0.0);
  double arm = arm_mass * k->arm_length, mass = inertia + k->inertia + arm * k->arm_length / 3.0;
  double weight = (k->gravity_moment + 0.5 * 9.80665 * arm) * sin(s->q);
  double load = fabs(weight + load_motor_share * (motor - weight));
  double turn = s->dq / stribeck_speed, bell = pow(1.0 + turn * turn / 16.0, -16.0);
  double dry = coulomb + (load_friction + load_square_friction * load) * load +
               (stribeck_friction + load_stribeck_friction * load) * bell +
               angle_friction_cos * cos(s->q) + angle_friction_sin * sin(s->q);
  dry = fmax(dry, 0.0);
  double net = motor - weight - offset - viscous * s->dq, speed = s->dq + net / mass * dt, drop = dry / mass * dt;
  /* dry friction holds, or slows down and does not turn round */
  speed = fabs(speed) <= drop ? 0.0 : speed < 0.0 ? speed + drop : speed - drop;
  s->q += 0.5 * (s->dq + speed) * dt;
  s->dq = speed;
}
)";

std::string c_number(double value) { return std::isinf(value) ? "INFINITY" : fmt::format("{:.17g}", value); }

}  // namespace

std::string servo_c(std::string const& document) {
  ServoModel const model = model_of(document);
  std::string text = fmt::format("/* {}: {}\n   Written by torquescope export. Units: SI. */\n", remark(model.name),
                                 remark(model.headline));
  text += fmt::format(
      fmt::runtime(numbers_in_c), fmt::arg("inertia", model["inertia"]), fmt::arg("viscous", model["viscous"]),
      fmt::arg("coulomb", model["coulomb"]), fmt::arg("offset", model["offset"]),
      fmt::arg("motor_gain", model["motor_gain"]), fmt::arg("back_emf", model["back_emf"]),
      fmt::arg("command_delay_s", model["command_delay_s"]), fmt::arg("torque_lag_s", model["torque_lag_s"]),
      fmt::arg("goal_speed_limit", c_number(model["goal_speed_limit"])),
      fmt::arg("goal_acceleration_limit", c_number(model["goal_acceleration_limit"])),
      fmt::arg("dead_band", model["dead_band"]), fmt::arg("punch", model["punch"]),
      fmt::arg("torque_limit", c_number(model["torque_limit"])), fmt::arg("load_friction", model["load_friction"]),
      fmt::arg("load_square_friction", model["load_square_friction"]),
      fmt::arg("stribeck_friction", model["stribeck_friction"]),
      fmt::arg("load_stribeck_friction", model["load_stribeck_friction"]),
      fmt::arg("stribeck_speed", model["stribeck_speed"]), fmt::arg("arm_mass", model["arm_mass"]),
      fmt::arg("load_motor_share", model["load_motor_share"]),
      fmt::arg("angle_friction_cos", model["angle_friction_cos"]),
      fmt::arg("angle_friction_sin", model["angle_friction_sin"]));
  return text + step_in_c;
}

std::string servo_toml(std::string const& document) {
  ServoModel const model = model_of(document);
  std::string given, loop;
  for (auto const& [name, value] : model.numbers)
    (loop_key_of(name) ? loop : given) += fmt::format("{} = {:.17g}\n", name, value);
  return fmt::format("# {}: {}\n\n[model.given]\n{}\n[loop]\n{}", remark(model.name), remark(model.headline), given,
                     loop);
}

}  // namespace torquescope
