#include "engine/data/packed_size.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"

namespace torquescope {

void refuse_bomb(std::uint64_t unpacked, std::uint64_t packed, std::string const& path) {
  validate(unpacked <= largest_unasked || unpacked / most_times <= packed, [&] {
    return bad_data(fmt::format("{} unpacks to more than {} times its size, as no recording does", path, most_times),
                    path, 0, "a bomb? if you trust it: unpack it (gunzip, unzip) and name what was in it in the job");
  });
}

}  // namespace torquescope
