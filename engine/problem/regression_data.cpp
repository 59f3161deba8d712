#include "engine/problem/regression_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"
#include "engine/base/huge_pages.hpp"

namespace torquescope {
namespace {

// columns of every term; what no later term needs of the motion is freed on the way
Eigen::MatrixXd columns_using_up(Motion& motion, Regressor const& regressor) {
  constexpr Eigen::Index block_rows = 4096;
  Eigen::Index const n = motion.q.size();
  auto const& columns = regressor.column_owners();
  auto const stretch = [](Eigen::VectorXd const& signal, Eigen::Index first, Eigen::Index count) -> Eigen::VectorXd {
    if (signal.size() == 0) return Eigen::VectorXd::Zero(count);  // freed: nobody looks
    return signal.segment(first, count);
  };
  // pages of phi are taken from the system when they are written, column by column
  Eigen::MatrixXd phi(n, static_cast<Eigen::Index>(columns.size()));
  in_huge_pages(phi);
  Eigen::Index column = 0;
  for (std::size_t term = 0; term < regressor.terms().size(); ++term) {
    bool position = false, velocity = false, acceleration = false, time = false;
    Eigen::Index width = 0;
    for (auto const& one : columns) {
      width += one.term == term;
      if (one.term < term) continue;
      position = position || one.needs_position;
      velocity = velocity || one.needs_velocity;
      acceleration = acceleration || one.needs_acceleration;
      time = time || one.needs_time;
    }
    if (!time) motion.time_s = Eigen::VectorXd();
    if (!position) motion.q = Eigen::VectorXd();
    if (!velocity) motion.dq = Eigen::VectorXd();
    if (!acceleration) motion.ddq = Eigen::VectorXd();
    for (Eigen::Index first = 0; first < n; first += block_rows) {
      Eigen::Index const count = std::min(block_rows, n - first);
      Motion const block{motion.rate_hz,
                         stretch(motion.time_s, first, count),
                         stretch(motion.q, first, count),
                         stretch(motion.dq, first, count),
                         stretch(motion.ddq, first, count),
                         {}};
      regressor.columns_of_term(block, term, phi.block(first, column, count, width));
    }
    column += width;
  }
  return phi;
}

// phi and tau of one recording, and what is kept of its motion
RegressionData rows_of(Motion&& motion, FilterOptions const& options, Regressor const& regressor,
                       Section const& section, RowMotion row_motion) {
  ParallelFilter const filter(options, motion.rate_hz, motion.q.size(), section);
  RegressionData rows;
  rows.kept_rate_hz = filter.kept_rate_hz();
  if (row_motion == RowMotion::used_up && filter.keeps_everything()) {
    rows.phi = columns_using_up(motion, regressor);
    rows.tau = std::move(motion.torque);
    return rows;
  }
  rows.phi = regressor.columns(motion);
  if (!filter.keeps_everything()) {
    Eigen::MatrixXd kept(filter.kept_samples(), rows.phi.cols());
    for (Eigen::Index r = 0; r < kept.cols(); ++r) kept.col(r) = filter.apply(rows.phi.col(r));
    rows.phi = std::move(kept);
    motion.torque = filter.apply(motion.torque);
    for (auto* signal : {&motion.time_s, &motion.q, &motion.dq, &motion.ddq}) *signal = filter.pick(*signal);
  }
  rows.tau = std::move(motion.torque);
  rows.time_s = std::move(motion.time_s);
  rows.q = std::move(motion.q);
  rows.dq = std::move(motion.dq);
  rows.ddq = std::move(motion.ddq);
  return rows;
}

Problem different_rates(std::string const& recording, double rate_hz, std::string const& first, double first_rate_hz,
                        Section const& section) {
  Problem problem{ExitCode::bad_data,
                  fmt::format("{} keeps {:.6g} samples a second, {} keeps {:.6g} (a fit would weigh them unequally)",
                              recording, rate_hz, first, first_rate_hz)};
  problem.place = section.where("decimate_to_hz");
  problem.key = "filter.decimate_to_hz";
  problem.help = fmt::format("write filter.decimate_to_hz = {:.6g} or lower", std::min(rate_hz, first_rate_hz));
  return problem;
}

void append(Eigen::VectorXd& whole, Eigen::VectorXd&& part) {
  if (whole.size() == 0) {
    whole = std::move(part);
    return;
  }
  auto const before = whole.size();
  whole.conservativeResize(before + part.size());
  whole.tail(part.size()) = part;
}

}  // namespace

std::size_t RegressionData::recording_of(Eigen::Index row) const {
  return static_cast<std::size_t>(std::upper_bound(first_row.begin(), first_row.end(), row) - first_row.begin()) - 1;
}

bool RegressionData::moves_both_ways() const {
  if (dq.size() == 0) return forgotten_forwards_ && forgotten_backwards_;
  return dq.minCoeff() < 0.0 && dq.maxCoeff() > 0.0;
}

void RegressionData::note_directions(Eigen::VectorXd const& velocity) {
  if (velocity.size() == 0) return;
  forgotten_forwards_ = forgotten_forwards_ || velocity.maxCoeff() > 0.0;
  forgotten_backwards_ = forgotten_backwards_ || velocity.minCoeff() < 0.0;
}

void RegressionData::forget_motion() {
  note_directions(dq);
  for (auto* signal : {&time_s, &q, &dq, &ddq}) *signal = Eigen::VectorXd();
}

void append_rows(RegressionData& data, std::string const& recording_name, Motion&& motion, FilterOptions const& options,
                 Regressor const& regressor, Section const& filter, RowMotion row_motion) {
  bool const is_first = data.recording_names.empty();
  double const rate_hz = motion.rate_hz;
  if (row_motion == RowMotion::used_up) data.note_directions(motion.dq);
  auto part = rows_of(std::move(motion), options, regressor, filter, row_motion);
  if (row_motion == RowMotion::used_up)
    for (auto* signal : {&part.time_s, &part.q, &part.dq, &part.ddq}) *signal = Eigen::VectorXd();
  if (is_first) {
    data.columns = regressor.column_owners();
    data.kept_rate_hz = part.kept_rate_hz;
    data.first_row = {0};
  }
  // rates are ratios of small numbers: equal ones differ by rounding at most
  validate(std::abs(part.kept_rate_hz - data.kept_rate_hz) <= 1e-9 * data.kept_rate_hz, [&] {
    return different_rates(recording_name, part.kept_rate_hz, data.recording_names.front(), data.kept_rate_hz, filter);
  });

  if (is_first) {
    data.phi = std::move(part.phi);
  } else {
    data.phi.conservativeResize(data.phi.rows() + part.phi.rows(), Eigen::NoChange);
    data.phi.bottomRows(part.phi.rows()) = part.phi;
  }
  append(data.tau, std::move(part.tau));
  append(data.time_s, std::move(part.time_s));
  append(data.q, std::move(part.q));
  append(data.dq, std::move(part.dq));
  append(data.ddq, std::move(part.ddq));
  data.first_row.push_back(data.tau.size());
  data.recording_names.push_back(recording_name);
  data.rate_hz.push_back(rate_hz);
}

RegressionData make_regression_data(std::vector<Recording> const& recordings, FilterOptions const& options,
                                    Regressor const& regressor, Section const& filter) {
  TORQUESCOPE_EXPECT(!recordings.empty());
  RegressionData data;
  for (auto const& recording : recordings)
    append_rows(data, recording.name, differentiate(recording, options, filter), options, regressor, filter);
  return data;
}

}  // namespace torquescope
