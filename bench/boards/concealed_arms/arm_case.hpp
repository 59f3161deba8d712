#pragma once
// From the name of a case to its plant, motions and recordings. The same name is the same bits.
//
//   clean:ARM:SEED                     nothing is concealed; ARM is crs (five joints) or seven
//   law:ARM:JOINT:LAW:SNR:SEED         LAW in words of the catalogue, as large as SNR after absorption (absorbed.hpp)
//   decoy:ARM:KIND:SEED                no physics: late (one torque channel), swapped (two columns), scaled (one gear)
//   A0:NUMBER[:SUITE], A1:..., A2:...  clean arms, laws, decoys, drawn: short for one of the three above
//
// Folder     says nothing of what is in it

#include <cstdint>
#include <string>

#include "concealed_arms/absorbed.hpp"
#include "concealed_arms/arm_loop.hpp"

namespace concealed_arms {

enum class CaseKind { clean, law, decoy };
enum class DecoyKind { late, swapped, scaled };

struct Decoy {
  DecoyKind kind = DecoyKind::late;
  int joint = 0, other = 0;
  int rows = 0;        // late by
  double scale = 1.0;  // of the logged torque
};

struct ArmCase {
  std::string name{}, folder{};
  CaseKind kind = CaseKind::clean;
  std::uint64_t seed = 0;
  Plant plant{};
  MotionKind motion = MotionKind::sines;
  bool averaged_log = false;  // mean of the torques in force before and after the row; else that from the row on
  double wanted_snr = 0.0;
  Decoy decoy{};
};

struct ArmRecording {
  ArmRun run;
  Eigen::MatrixXd torque;  // as logged: joints x rows [N m]
};

struct MadeCase {
  ArmCase of;  // with the size that was found
  ArmRecording train, validate;
  Left left;  // of the training recording
};

// std::invalid_argument for a name that is none
ArmCase parse_case(std::string const& name);
std::string spelled_out(std::string const& name);  // A1:17 -> law:crs:...
std::string folder_of(std::string const& name);

// sizes the law, records twice
MadeCase make_case(ArmCase const& wanted);
// rms after absorption of the run itself, without noise
Left left_of(ArmCase const& one_case, ArmRun const& run);

}  // namespace concealed_arms
