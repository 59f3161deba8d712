#include "engine/fit/problem/regression_data.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"
#include "engine/base/huge_pages.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/fit/problem/unequal_rates.hpp"

namespace torquescope {
namespace {

// of a recording's row; every reader of files and every simulation divides alike
double even_time(Eigen::Index row, double rate_hz) { return static_cast<double>(row) / rate_hz; }

// both zero of nothing
std::pair<double, double> range_of(std::span<double const> values) {
  if (values.empty()) return {0.0, 0.0};
  Eigen::Map<Eigen::ArrayXd const> const array(values.data(), static_cast<Eigen::Index>(values.size()));
  return {array.minCoeff(), array.maxCoeff()};
}

bool same_bits(Eigen::VectorXd const& vector, double const* column) {
  auto const bytes = static_cast<std::size_t>(vector.size()) * sizeof(double);
  return vector.size() > 0 && std::memcmp(vector.data(), column, bytes) == 0;
}

std::span<double const> numbers_of(Eigen::VectorXd const& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

std::span<double const> column_or(Eigen::VectorXd const& signal, std::optional<Eigen::Index> column,
                                  Eigen::MatrixXd const& phi) {
  if (column) return {phi.col(*column).data(), static_cast<std::size_t>(phi.rows())};
  return numbers_of(signal);
}

struct Needs {
  bool position = false, velocity = false, acceleration = false, time = false;

  void add(RegressorColumn const& column) {
    position = position || column.needs_position;
    velocity = velocity || column.needs_velocity;
    acceleration = acceleration || column.needs_acceleration;
    time = time || column.needs_time;
  }
};

// The columns of every term, one term after the other. A used up motion goes as soon as no later term needs it,
// velocity and acceleration anyway when phi holds them
void make_columns(Motion& motion, Regressor const& regressor, RowMotion row_motion, RegressionData& rows) {
  constexpr Eigen::Index block_rows = 4096;
  Eigen::Index const n = motion.q.size();
  // pages of phi are taken from the system when they are written, column by column
  rows.phi.resize(n, static_cast<Eigen::Index>(regressor.size()));
  in_huge_pages(rows.phi);
  RegressionData::SameColumns& same = rows.same_columns;
  Eigen::Index column = 0;
  for (std::size_t term = 0; term < regressor.terms().size(); ++term) {
    Needs now, from_now_on;
    Eigen::Index end = column;
    for (auto const& one : regressor.column_owners()) {
      end += one.term == term;
      if (one.term == term) now.add(one);
      if (one.term >= term) from_now_on.add(one);
    }
    if (row_motion == RowMotion::used_up) {
      if (!from_now_on.time) motion.time_s = Eigen::VectorXd();
      if (!from_now_on.position) motion.q = Eigen::VectorXd();
      if (!from_now_on.velocity) motion.dq = Eigen::VectorXd();
      if (!from_now_on.acceleration) motion.ddq = Eigen::VectorXd();
    }
    Motion block;
    block.rate_hz = motion.rate_hz;
    for (Eigen::Index first = 0; first < n; first += block_rows) {
      Eigen::Index const count = std::min(block_rows, n - first);
      auto const velocity = column_or(motion.dq, same.velocity, rows.phi);
      auto const acceleration = column_or(motion.ddq, same.acceleration, rows.phi);
      auto const stretch = [&](bool needed, std::span<double const> signal, Eigen::VectorXd& out) {
        if (needed)
          out = Eigen::Map<Eigen::VectorXd const>(signal.data() + first, count);
        else if (out.size() != count)
          out.setZero(count);  // nobody looks
      };
      stretch(now.time, numbers_of(motion.time_s), block.time_s);
      stretch(now.position, numbers_of(motion.q), block.q);
      stretch(now.velocity, velocity, block.dq);
      stretch(now.acceleration, acceleration, block.ddq);
      regressor.columns_of_term(block, term, rows.phi.block(first, column, count, end - column));
    }
    for (; column < end; ++column) {
      for (auto [signal, place] : {std::pair(&motion.dq, &same.velocity), std::pair(&motion.ddq, &same.acceleration)}) {
        if (!same_bits(*signal, rows.phi.col(column).data())) continue;
        *signal = Eigen::VectorXd();
        *place = column;
      }
    }
  }
}

// no term needs the time, and the rate tells it
bool is_told_by_rate(Eigen::VectorXd const& time_s, double rate_hz, Regressor const& regressor) {
  for (auto const& column : regressor.column_owners())
    if (column.needs_time) return false;
  for (Eigen::Index i = 0; i < time_s.size(); ++i)
    if (std::bit_cast<std::uint64_t>(time_s[i]) != std::bit_cast<std::uint64_t>(even_time(i, rate_hz))) return false;
  return true;
}

// the filter's rows outside of what the recording leaves out; empty where that is all of them
std::vector<Eigen::Index> rows_looked_at(Motion const& motion, FilterOptions const& options,
                                         ParallelFilter const& filter) {
  std::vector<Eigen::Index> kept;
  if (motion.left_out.empty()) return kept;
  auto const out = left_out_samples(motion, parallel_cutoff_of(options));
  Eigen::VectorXd as_numbers(static_cast<Eigen::Index>(out.size()));
  for (std::size_t k = 0; k < out.size(); ++k) as_numbers[static_cast<Eigen::Index>(k)] = out[k] ? 1.0 : 0.0;
  Eigen::VectorXd const picked = filter.pick(as_numbers);
  for (Eigen::Index i = 0; i < picked.size(); ++i)
    if (picked[i] == 0.0) kept.push_back(i);
  return kept;
}

// phi and tau of one recording, and what is kept of its motion
RegressionData rows_of(Motion&& motion, FilterOptions const& options, Regressor const& regressor,
                       Section const& section, RowMotion row_motion) {
  ParallelFilter const filter(options, motion.rate_hz, motion.q.size(), section);
  RegressionData rows;
  rows.kept_rate_hz = filter.kept_rate_hz();
  auto const kept = rows_looked_at(motion, options, filter);
  if (!kept.empty()) row_motion = RowMotion::kept;
  if (row_motion != RowMotion::kept && filter.keeps_everything()) {
    if (row_motion == RowMotion::once && is_told_by_rate(motion.time_s, rows.kept_rate_hz, regressor))
      motion.time_s = Eigen::VectorXd();
    make_columns(motion, regressor, row_motion, rows);
  } else {
    rows.phi = regressor.columns(motion);
  }
  if (!filter.keeps_everything()) {
    Eigen::MatrixXd filtered(filter.kept_samples(), rows.phi.cols());
    for (Eigen::Index r = 0; r < filtered.cols(); ++r) filtered.col(r) = filter.apply(rows.phi.col(r));
    rows.phi = std::move(filtered);
    motion.torque = filter.apply(motion.torque);
    for (auto* signal : {&motion.time_s, &motion.q, &motion.dq, &motion.ddq}) *signal = filter.pick(*signal);
  }
  rows.tau = std::move(motion.torque);
  if (!kept.empty()) {
    rows.phi = rows.phi(kept, Eigen::all).eval();
    for (auto* signal : {&rows.tau, &motion.time_s, &motion.q, &motion.dq, &motion.ddq})
      *signal = (*signal)(kept).eval();
  }
  rows.time_s = std::move(motion.time_s);
  rows.q = std::move(motion.q);
  rows.dq = std::move(motion.dq);
  rows.ddq = std::move(motion.ddq);
  return rows;
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

void drop_motion(RegressionData& data) {
  for (auto* signal : {&data.time_s, &data.q, &data.dq, &data.ddq}) *signal = Eigen::VectorXd();
  data.same_columns = {};
}

}  // namespace

std::size_t RegressionData::recording_of(Eigen::Index row) const {
  return static_cast<std::size_t>(std::upper_bound(first_row.begin(), first_row.end(), row) - first_row.begin()) - 1;
}

void RegressionData::time(std::size_t first, std::span<double> seconds) const {
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    auto const row = static_cast<Eigen::Index>(first + i);
    seconds[i] = time_s.size() > 0 ? time_s[row] : even_time(row, kept_rate_hz);
  }
}

std::span<double const> RegressionData::velocity() const { return column_or(dq, same_columns.velocity, phi); }
std::span<double const> RegressionData::acceleration() const { return column_or(ddq, same_columns.acceleration, phi); }

bool RegressionData::moves_both_ways() const {
  auto const [least, most] = range_of(velocity());
  return (forgotten_forwards_ || most > 0.0) && (forgotten_backwards_ || least < 0.0);
}

void RegressionData::note_directions(std::span<double const> velocity) {
  auto const [least, most] = range_of(velocity);
  forgotten_forwards_ = forgotten_forwards_ || most > 0.0;
  forgotten_backwards_ = forgotten_backwards_ || least < 0.0;
}

void RegressionData::forget_motion() {
  note_directions(velocity());
  drop_motion(*this);
}

void append_rows(RegressionData& data, std::string const& recording_name, Motion&& motion, FilterOptions const& options,
                 Regressor const& regressor, Section const& filter, RowMotion row_motion) {
  bool const is_first = data.recording_names.empty();
  double const rate_hz = motion.rate_hz;
  TORQUESCOPE_EXPECT(row_motion != RowMotion::once || is_first);
  if (row_motion == RowMotion::used_up) data.note_directions(numbers_of(motion.dq));
  auto part = rows_of(std::move(motion), options, regressor, filter, row_motion);
  if (row_motion == RowMotion::used_up) drop_motion(part);
  if (is_first) {
    data.columns = regressor.column_owners();
    data.kept_rate_hz = part.kept_rate_hz;
    data.first_row = {0};
  }
  check_kept_rate(recording_name, part.kept_rate_hz, is_first ? recording_name : data.recording_names.front(),
                  data.kept_rate_hz, filter);

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
  if (row_motion == RowMotion::once) data.same_columns = part.same_columns;
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
