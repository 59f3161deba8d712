#include "engine/store/look_at_result.hpp"

#include "engine/base/confined.hpp"
#include "engine/base/error.hpp"

namespace torquescope {

void look_at_result(std::filesystem::path const& file, std::function<void(ResultReader const&)> const& look) {
  auto const read = [&] {
    look(ResultReader(file));
    return std::string();
  };
  run_confined(read, limits_for_file(file, 60), [&file](std::string const& how) {
    return Problem{.code = ExitCode::bad_data,
                   .what = file.string() + " is damaged: HDF5 " + how + " while reading it",
                   .help = "delete it and run the job again: the same command makes the same file"};
  });
}

}  // namespace torquescope
