// Names of cases: read, drawn, and the folder they get (arm_case.hpp).
#include <array>
#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "concealed_arms/arm_case.hpp"

namespace concealed_arms {
namespace {

std::vector<std::string> parts(std::string const& name) {
  std::vector<std::string> found(1);
  for (char letter : name) {
    if (letter == ':')
      found.emplace_back();
    else
      found.back() += letter;
  }
  return found;
}

[[noreturn]] void refuse(std::string const& name) {
  throw std::invalid_argument("no case is called " + name +
                              ": write clean:ARM:SEED, law:ARM:JOINT:LAW:SNR:SEED, decoy:ARM:KIND:SEED or A1:NUMBER");
}

std::uint64_t whole(std::string const& word, std::string const& name) {
  std::uint64_t value = 0;
  auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || word.size() > 12) refuse(name);
  return value;
}

double number(std::string const& word, std::string const& name) {
  double value = 0.0;
  auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !(value > 0.0 && value < 1000.0)) refuse(name);
  return value;
}

// laws and sizes by turns, so that every stretch of numbers has all of them, and a law another size the next time; the
// joint by chance
std::string drawn_law_name(std::uint64_t number, std::string const& seed, concealed::Random& random) {
  constexpr std::array sizes = {1, 2, 4, 8};
  std::string const arm = number % 6 == 0 ? "seven" : "crs";
  LawWords const& words = law_words()[(number - 1) % law_words().size()];
  auto joints = possible_joints(words.kind, nominal_arm(arm));
  bool const needs_load = words.kind == LawKind::load_friction || words.kind == LawKind::elastic_joint;
  if (needs_load) joints.resize(joints.size() / 2 + 1);  // a wrist carries next to nothing
  int const joint = joints[random.index(joints.size())] + 1;
  return "law:" + arm + ":" + std::to_string(joint) + ":" + words.name + ":" +
         std::to_string(sizes[(number - 1 + (number - 1) / law_words().size()) % sizes.size()]) + ":" + seed;
}

Decoy drawn_decoy(DecoyKind kind, int joints, std::uint64_t seed) {
  concealed::Random random(seed, "decoy");
  Decoy decoy{.kind = kind, .joint = static_cast<int>(random.index(static_cast<std::size_t>(joints)))};
  decoy.rows = 5 + static_cast<int>(random.index(10));  // 10 to 28 ms
  decoy.other = (decoy.joint + 1 + static_cast<int>(random.index(static_cast<std::size_t>(joints - 1)))) % joints;
  decoy.scale = random.uniform() < 0.5 ? random.between(0.5, 0.8) : random.between(1.25, 1.8);
  return decoy;
}

DecoyKind decoy_kind(std::string const& word, std::string const& name) {
  if (word == "late") return DecoyKind::late;
  if (word == "swapped") return DecoyKind::swapped;
  if (word == "scaled") return DecoyKind::scaled;
  refuse(name);
}

// the specimen, its loop, its log and the kind of its motion
ArmCase drawn_case(std::string const& name, std::string const& arm, std::uint64_t seed) {
  ArmCase one{.name = name, .folder = folder_of(name), .seed = seed, .plant = {.arm = drawn_arm(arm, seed)}};
  concealed::Random random(seed, "loop");
  one.motion = random.uniform() < 0.75 ? MotionKind::sines : MotionKind::moves;
  one.averaged_log = random.uniform() < 0.5;
  Controller& loop = one.plant.controller;
  loop.bandwidth_hz = random.between(4.0, 8.0);
  loop.damping = random.between(0.8, 1.1);
  loop.integral_share = random.uniform() < 0.5 ? 0.0 : random.between(0.05, 0.15);
  loop.weight_share = random.between(0.93, 1.05);
  return one;
}

double mean_inertia_of_links(Arm const& arm, int joint, ArmMotion const& motion) {
  MujocoArm still(arm, upright);
  Eigen::VectorXd const rest = Eigen::VectorXd::Zero(arm.joints());
  constexpr Eigen::Index poses = 50;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < poses; ++i) {
    still.update(motion.q.col(i * (motion.q.cols() - 1) / (poses - 1)), rest);
    sum += still.mass()(joint, joint);
  }
  return sum / poses - arm.links[static_cast<std::size_t>(joint)].drive_inertia;
}

void conceal(ArmCase& one, LawKind kind, std::uint64_t joint) {
  concealed::Random random(one.seed, "law");
  int const joints = one.plant.arm.joints();
  if (joint < 1 || joint > static_cast<std::uint64_t>(joints)) refuse(one.name);
  auto const j = static_cast<int>(joint) - 1;
  ArmMotion const motion = drawn_motion(one.motion, one.plant.arm, one.seed, "train");
  one.plant.law =
      drawn_law(kind, one.plant.arm, j,
                {motion.travel()[j], motion.fastest()[j], mean_inertia_of_links(one.plant.arm, j, motion)}, random);
  // a loop that is tuned to the whole joint makes a drive that is much lighter tremble behind its spring
  double& drive = one.plant.arm.links[static_cast<std::size_t>(j)].drive_inertia;
  if (kind == LawKind::elastic_joint) drive = std::max(drive, 0.3 * one.plant.law->second);
}

}  // namespace

std::string spelled_out(std::string const& name) {
  auto const words = parts(name);
  if (words[0].size() != 2 || words[0][0] != 'A') return name;
  char const tier = words[0][1];
  if (tier < '0' || tier > '2' || words.size() < 2 || words.size() > 3) refuse(name);
  std::uint64_t const number = whole(words[1], name), suite = words.size() == 3 ? whole(words[2], name) : 0;
  if (number == 0 || number >= 10000) refuse(name);
  std::uint64_t const value = number + 10000 * static_cast<std::uint64_t>(tier - '0') + 100000 * suite;
  std::string const seed = std::to_string(value), arm = number % 5 == 0 ? "seven" : "crs";
  if (tier == '0') return "clean:" + arm + ":" + seed;
  constexpr std::array decoys = {"late", "swapped", "scaled"};
  if (tier == '2') return "decoy:" + arm + ":" + decoys[(number - 1) % decoys.size()] + ":" + seed;
  concealed::Random random(value, "name");
  return drawn_law_name(number, seed, random);
}

std::string folder_of(std::string const& name) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (char letter : spelled_out(name)) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  char text[24];
  std::snprintf(text, sizeof text, "arm_%012llx", static_cast<unsigned long long>(hash >> 16));
  return text;
}

ArmCase parse_case(std::string const& name) {
  std::string const full = spelled_out(name);
  auto const words = parts(full);
  if (words[0] == "clean" && words.size() == 3) return drawn_case(full, words[1], whole(words[2], name));
  if (words[0] == "decoy" && words.size() == 4) {
    ArmCase one = drawn_case(full, words[1], whole(words[3], name));
    one.kind = CaseKind::decoy;
    one.decoy = drawn_decoy(decoy_kind(words[2], name), one.plant.arm.joints(), one.seed);
    return one;
  }
  if (words[0] == "law" && words.size() == 6) {
    ArmCase one = drawn_case(full, words[1], whole(words[5], name));
    one.kind = CaseKind::law;
    one.wanted_snr = number(words[4], name);
    conceal(one, words_of(words[3]).kind, whole(words[2], name));
    return one;
  }
  refuse(name);
}

}  // namespace concealed_arms
