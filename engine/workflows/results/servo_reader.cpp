#include "engine/workflows/results/servo_reader.hpp"

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/experiment/stored_objects.hpp"

namespace torquescope {

bool has_servo(ResultReader const& reader) { return reader.exists("/servo"); }

KeptServo read_servo(ResultReader const& reader) {
  constexpr Verdict all[] = {Verdict::none,        Verdict::named,        Verdict::one_of_class, Verdict::partly,
                             Verdict::unexplained, Verdict::insufficient, Verdict::data_fault};
  StoredObjects const in(reader);
  std::string const said = in.text("/servo", "verdict");
  auto const verdict = std::find_if(std::begin(all), std::end(all), [&](Verdict one) { return word(one) == said; });
  auto const texts = in.text_column("/servo/printed"), json = in.text_column("/servo/json");
  validate(verdict != std::end(all) && texts.size() == 2 && json.size() == 1, [] {
    return Problem{.code = ExitCode::bad_data,
                   .what = "the group /servo of the result is damaged",
                   .help = "delete it and run the job again: the same command makes the same file"};
  });
  return {*verdict, texts[0], texts[1], json[0]};
}

}  // namespace torquescope
