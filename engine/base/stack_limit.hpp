#pragma once
// The temporaries of matrix products lie on the stack: where it is limited to less, the process would end by a
// segmentation fault in the middle of its work.

namespace torquescope {

// throws 70 where the stacks of this process are limited (ulimit -s) to less than 1 MiB
void refuse_small_stack();

}  // namespace torquescope
