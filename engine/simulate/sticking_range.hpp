#pragma once
// How far the sticking of dry friction is unknown: every replicate draws its own.
//
// Creep      speed up to which friction grows with the speed: 0.1 to 20 mrad/s (mm/s), all sizes alike; in steps of the
//            encoder per second where these are coarser, for what is slower than that no recording shows
// Bending    way over which friction builds up: 0 to 3 steps of the encoder, a longer one is an effect of its own
//            (effects/presliding.cpp). Every second replicate has none; of the others, all square roots alike
// Units      SI: rad/s or m/s; rad or m
// Threads    plain record, free function
// Source     presliding and creep: Armstrong-Helouvry, Dupont, Canudas de Wit 1994, doi:10.1016/0005-1098(94)90209-7

namespace torquescope {

struct StickingRange {
  double least_creep = 0.0, most_creep = 0.0;
  double most_length = 0.0;
  bool is_any() const { return most_creep > 0.0 || most_length > 0.0; }  // none: friction holds at once
};

}  // namespace torquescope
