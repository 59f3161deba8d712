#include "engine/problem/regression_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"

namespace torquescope {
namespace {

// one recording's rows
RegressionData rows_of(Recording const& recording, FilterOptions const& options, Regressor const& regressor,
                       Section const& section) {
  auto const motion = differentiate(recording, options, section);
  ParallelFilter const filter(options, motion.rate_hz, motion.q.size(), section);
  auto const full_rate = regressor.columns(motion);

  RegressionData rows;
  rows.phi.resize(filter.kept_samples(), full_rate.cols());
  for (Eigen::Index r = 0; r < full_rate.cols(); ++r) rows.phi.col(r) = filter.apply(full_rate.col(r));
  rows.tau = filter.apply(motion.torque);
  rows.time_s = filter.pick(motion.time_s);
  rows.q = filter.pick(motion.q);
  rows.dq = filter.pick(motion.dq);
  rows.ddq = filter.pick(motion.ddq);
  rows.kept_rate_hz = filter.kept_rate_hz();
  return rows;
}

Problem different_rates(Recording const& recording, double rate_hz, Recording const& first, double first_rate_hz,
                        Section const& section) {
  Problem problem{ExitCode::bad_data,
                  fmt::format("{} keeps {:.6g} samples a second, {} keeps {:.6g} (a fit would weigh them unequally)",
                              recording.name, rate_hz, first.name, first_rate_hz)};
  problem.place = section.where("decimate_to_hz");
  problem.key = "filter.decimate_to_hz";
  problem.help = fmt::format("write filter.decimate_to_hz = {:.6g} or lower", std::min(rate_hz, first_rate_hz));
  return problem;
}

void append(Eigen::VectorXd& whole, Eigen::VectorXd const& part) {
  auto const before = whole.size();
  whole.conservativeResize(before + part.size());
  whole.tail(part.size()) = part;
}

}  // namespace

RegressionData make_regression_data(std::vector<Recording> const& recordings, FilterOptions const& options,
                                    Regressor const& regressor, Section const& filter) {
  TORQUESCOPE_EXPECT(!recordings.empty());
  RegressionData data;
  data.columns = regressor.column_owners();
  data.phi.resize(0, static_cast<Eigen::Index>(regressor.size()));
  data.first_row = {0};
  for (auto const& recording : recordings) {
    auto const part = rows_of(recording, options, regressor, filter);
    if (data.recording_names.empty()) data.kept_rate_hz = part.kept_rate_hz;
    // rates are ratios of small numbers: equal ones differ by rounding at most
    validate(std::abs(part.kept_rate_hz - data.kept_rate_hz) <= 1e-9 * data.kept_rate_hz, [&] {
      return different_rates(recording, part.kept_rate_hz, recordings.front(), data.kept_rate_hz, filter);
    });

    data.phi.conservativeResize(data.phi.rows() + part.phi.rows(), Eigen::NoChange);
    data.phi.bottomRows(part.phi.rows()) = part.phi;
    append(data.tau, part.tau);
    append(data.time_s, part.time_s);
    append(data.q, part.q);
    append(data.dq, part.dq);
    append(data.ddq, part.ddq);
    data.recording.insert(data.recording.end(), static_cast<std::size_t>(part.tau.size()),
                          static_cast<std::int64_t>(data.recording_names.size()));
    data.first_row.push_back(data.tau.size());
    data.recording_names.push_back(recording.name);
    data.rate_hz.push_back(recording.rate_hz);
  }
  return data;
}

}  // namespace torquescope
