#include "engine/experiment/runs/code_identity.hpp"

#include <Eigen/Core>

#include "engine/base/digest.hpp"
#include "engine/base/version.hpp"

namespace torquescope {

std::string numerics_sha256() {
  Digest digest;
  for (char const* part : {sources_sha256(), version, compiler, build_type}) digest.text(part);
  for (int const number : {EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION})
    digest.text(std::to_string(number));
  return digest.hex();
}

}  // namespace torquescope
