#include "engine/robot/standard_dh.hpp"

#include <utility>

namespace torquescope {

SerialChain from_standard_dh(SerialChain chain) {
  ChainJoint before;  // of the joint before: nothing before the first
  before.a = before.alpha = 0.0;
  FramePose last;
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    auto& joint = chain.joints[i];
    // Tx(a) Rx(alpha): the standard frame seen from the modified one of the same joint
    ChainJoint behind;
    behind.a = joint.a;
    behind.alpha = joint.alpha;
    last = joint_pose(behind, 0.0);
    if (chain.has_inertias()) chain.links[i] = chain.links[i].seen_from(last);
    std::swap(joint.a, before.a);
    std::swap(joint.alpha, before.alpha);
  }
  chain.flange = last * chain.flange;
  return chain;
}

}  // namespace torquescope
