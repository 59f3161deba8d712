#pragma once
// Rows that repeat the one before although the joint moves: a packet was lost, a channel is read slower than it is
// logged.
//
// Equation   k rows stand still between two that move, and the row after them makes up for it: the way over the k + 1
//            steps is what the steps before and after lead one to expect, (k + 1) s, and s is more than two encoder
//            steps
// Repair     marked as missing; health/make_recording.cpp fills up to longest_filled_gap samples
// Threads    free function

#include "engine/data/health/examination.hpp"

namespace torquescope {

void examine_repeated_rows(Examination& exam);

}  // namespace torquescope
