#include "servo/laws.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "servo/chance.hpp"
#include "servo/joint.hpp"

namespace servo {
namespace {

constexpr double reserve = 0.95;  // of the greatest torque that lifting may need
constexpr std::uint64_t most_attempts = 1000;

// Three digits, so that a truth in words is the whole truth
double draw(Chance& chance, double low, double high) {
  double const x = chance.between(low, high);
  double const unit = std::pow(10.0, std::floor(std::log10(x)) - 2.0);
  return std::round(x / unit) * unit;
}

ServoNumbers draw_once(std::uint64_t seed, std::uint64_t attempt, std::vector<std::string> const& with) {
  Chance chance{seed, Purpose::base, attempt};
  ServoNumbers servo;
  servo.inertia = draw(chance, 0.020, 0.030);
  servo.viscous = draw(chance, 0.03, 0.07);
  servo.coulomb = draw(chance, 0.07, 0.13);
  servo.motor_gain = draw(chance, 0.20, 0.26);
  servo.back_emf = draw(chance, 0.12, 0.25);
  // an effect's number does not hang on which others there are
  Chance of_laws{seed, Purpose::law_numbers, attempt};
  for (Law const& law : laws) {
    double const number = draw(of_laws, law.low, law.high);
    if (std::find(with.begin(), with.end(), law.name) != with.end()) servo.*law.number = number;
  }
  servo.stribeck_speed = draw(of_laws, 0.1, 0.5);
  return servo;
}

}  // namespace

Law const& law_named(std::string const& name) {
  for (Law const& law : laws)
    if (name == law.name) return law;
  std::string all;
  for (Law const& law : laws) all += std::string{all.empty() ? "" : ", "} + law.name;
  throw std::invalid_argument("no law is called " + name + " (there are " + all + ")");
}

bool lifts(ServoNumbers const& servo, Setting const& setting) {
  // tm = weight + F(l), l = (tm + weight) / 2: what the greatest torque leaves must not be friction's
  double const weight = Joint{servo, setting}.gravity_moment();
  double const given = reserve * servo.motor_gain * setting.command_limit();
  double const load = 0.5 * (given + weight);
  double const friction = servo.coulomb + servo.stribeck_friction + (servo.load_friction + servo.load_stribeck) * load +
                          servo.load_square * load * load + servo.angle_friction;
  return given - weight > friction;
}

ServoNumbers draw_servo(std::uint64_t seed, std::vector<std::string> const& with, Setting const& heaviest) {
  for (auto const& name : with) law_named(name);
  for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
    ServoNumbers const servo = draw_once(seed, attempt, with);
    if (lifts(servo, heaviest)) return servo;
  }
  throw std::invalid_argument("no servo with these laws lifts the heaviest load; take less mass or length");
}

}  // namespace servo
