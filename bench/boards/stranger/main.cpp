// stranger CASE FOLDER: writes the recordings, the job and (apart) the truth of a case.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "stranger/case_writer.hpp"

namespace {

char const* const usage =
    "usage: stranger CASE FOLDER [--without] [--only K] [--scale X] [--steps N] [--no-noise] [--no-pushes]\n"
    "       stranger --list\n"
    "  --without   conceal nothing: the same motion and noise\n"
    "  --only K    of several effects only the K-th, from 0\n"
    "  --scale X   of what is concealed\n"
    "  --steps N   of the integrator in a tick of the control loop [2]\n"
    "  --no-noise  the torque channel and the tachometer are perfect\n"
    "  --no-pushes no coloured torque from outside\n";

int run(std::vector<std::string> const& words) {
  using namespace stranger;
  if (words.size() == 1 && words[0] == "--list") {
    for (auto const& each : all_cases()) std::cout << each.name << ' ' << each.kind << '\n';
    return 0;
  }
  if (words.size() < 2) {
    std::cerr << usage;
    return 64;
  }
  Options options;
  for (std::size_t k = 2; k < words.size(); ++k) {
    bool const has_value = k + 1 < words.size();
    if (words[k] == "--without") {
      options.without = true;
    } else if (words[k] == "--no-noise") {
      options.noise = false;
    } else if (words[k] == "--no-pushes") {
      options.pushes = false;
    } else if (words[k] == "--only" && has_value) {
      options.only = std::stoi(words[++k]);
    } else if (words[k] == "--scale" && has_value) {
      options.scale = std::stod(words[++k]);
    } else if (words[k] == "--steps" && has_value) {
      options.steps_per_tick = std::stoi(words[++k]);
    } else {
      std::cerr << usage;
      return 64;
    }
  }
  auto const& cases = all_cases();
  auto const which = std::find_if(cases.begin(), cases.end(), [&](Case const& c) { return c.name == words[0]; });
  if (which == cases.end()) {
    std::cerr << "no case is called " << words[0] << " (stranger --list)\n";
    return 64;
  }
  write_case(*which, words[1], options);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (std::exception const& problem) {
    std::cerr << "stranger: " << problem.what() << '\n';
    return 70;
  }
}
