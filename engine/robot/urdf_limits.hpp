#pragma once
// A URDF must write the effort and the speed of a joint, and the range of a slide, even where nobody knows them.

namespace torquescope {

// N m or N, rad/s or m/s, m: far beyond any joint, so that a reader takes it for no limit
inline constexpr double urdf_unlimited = 1e6;

}  // namespace torquescope
