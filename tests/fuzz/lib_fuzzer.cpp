// One reader under clang's libFuzzer; TORQUESCOPE_FUZZED names it (CMakeLists.txt).
#include "engine/base/error.hpp"
#include "tests/fuzz/hostile_reader.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t most, unsigned) {
  std::size_t const changed = LLVMFuzzerMutate(bytes, size, most);
  if (torquescope::TORQUESCOPE_FUZZED.mend) torquescope::TORQUESCOPE_FUZZED.mend({bytes, changed});
  return changed;
}

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* bytes, std::size_t size) {
  try {
    torquescope::TORQUESCOPE_FUZZED.read({reinterpret_cast<char const*>(bytes), size});
  } catch (torquescope::Error const&) {
    // refused, as it should be
  }
  return 0;
}
