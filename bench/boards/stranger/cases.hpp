#pragma once
// The tables of cases, and what is usual on a rig before a case says otherwise.
#include "stranger/case.hpp"

namespace stranger {

// encoder lines per rad of an encoder of so many bits per turn
double encoder_bits(int bits);
Case usual(std::string name, std::string kind, std::string rig);
// one concealed law, which gives the case its name
Case single(std::string effect, std::string rig, std::string train, std::string validation, double train_s,
            ConcealedLaw law, Place place = {});

std::vector<Case> clean_cases();
std::vector<Case> friction_cases();
std::vector<Case> structure_cases();
std::vector<Case> further_cases();

}  // namespace stranger
