#pragma once
// Trials of DE/current-to-pbest/1/bin with an archive, each with controls of its own: what JADE and L-SHADE share.
//
// Equation   v = x + F (x_pbest - x) + F (x_r1 - x_r2); pbest among the best share of the population, at least two; r1
//            of the population, r2 of population and archive; the target, r1 and r2 all different
// Random     a trial: controls, pbest, r1, r2, j_rand, parameters, repairs
// Source     Zhang, Sanderson: JADE, IEEE TEC 13 (2009), eq. 7, doi:10.1109/TEVC.2009.2014613

#include <cstddef>
#include <vector>

#include "engine/fit/optim/member_archive.hpp"
#include "engine/fit/optim/trial_controls.hpp"

namespace torquescope {

// members, in whole numbers
std::size_t share_of_members(double share, std::size_t n_members);

struct PBestTrials {
  MatrixView<double const> members;
  std::span<double const> fitness;
  MemberArchive const& archive;
  Bounds const& bounds;
  double best_share;
  BoundRepair repair;
  std::size_t first = 0;  // target of the first trial; the others follow
};

void make_current_to_pbest_trials(PBestTrials const& of, DrawControls const& draw, TrialStreams const& streams,
                                  MatrixView<double> const& trials);

// how far fitness fell, halved so that it cannot overflow; 0 where that cannot be measured
double improvement(double before, double after);
double improvement_of(Selected const& step, std::size_t member);

}  // namespace torquescope
