#pragma once
// Closed form estimators: each one turns the linear problem into parameters in one call. One per file in estimators/.
//
// Errors     prepare() appends Problems (78); the returned function throws Error 65 for data that cannot be fitted
// Threads    the returned function is const in effect: any number of threads

#include <functional>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/fit/problem/least_squares.hpp"

namespace torquescope {

using Estimate = std::function<LeastSquaresFit(RegressionData const&)>;

// how one kind of estimator is made, checked and described; the closed form sibling of OptimiserChoice
struct EstimatorChoice {
  std::string name;    // "irls"
  std::string title;   // "Huber's robust regression"
  std::string source;  // paper
  // every option with its default; what `describe irls` prints
  std::vector<OptionDescription> options;
  // reads the options of an [[estimator]] section ("name" and other callers' keys in `ignored`), appending problems
  std::function<Estimate(Section const&, std::vector<std::string> const& ignored, std::vector<Problem>&)> prepare;
  bool needs_instruments = false;  // RegressionData::Arm::instruments
  bool needs_gains = false;        // drive gains of an arm among the parameters
  bool needs_links = false;        // an arm

  bool fits_any_rows() const { return !needs_instruments && !needs_gains && !needs_links; }
};

// every estimator that CMakeLists.txt lists, in that order
std::vector<EstimatorChoice> const& estimator_choices();
// nullptr when there is none of this name
EstimatorChoice const* find_estimator(std::string const& name);

// the option that all of them have; -1 in Options means automatic
template <class Options>
Option<Options> hac_lags_option() {
  return {"hac_lags", &Options::hac_lags,
          "samples",  -1,
          1e9,        "lags of the Newey-West errors; -1: from the data (Andrews), 0: White"};
}

// reads a section by a table and binds the options to `fit`: the whole of most prepare functions
template <class Options>
auto prepare_with(LeastSquaresFit (*fit)(RegressionData const&, Options const&)) {
  return [fit](Section const& section, std::vector<std::string> const& ignored, std::vector<Problem>& problems) {
    Options options;
    Options::table().apply(section, options, problems, ignored);
    return Estimate([fit, options](RegressionData const& data) { return fit(data, options); });
  };
}

}  // namespace torquescope
