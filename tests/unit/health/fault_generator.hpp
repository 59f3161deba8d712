#pragma once
// Faults of every kind put into drawn recordings: other rates, lengths, ranges, encoders, noises, motions and joints
// for each number. Nobody has looked at them; no level of engine/data/health was set by them.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "engine/data/finding.hpp"
#include "engine/data/health/examination.hpp"
#include "unit/health/sample_recording.hpp"

namespace torquescope::health_test {

// a recording as it was drawn; columns t_s, q_rad, tau_Nm, qd_radps, r_rad
struct DrawnRecording {
  RawTable table;
  RecordingOptions options;
  double encoder_step = 0.0, rate_hz = 0.0;
  std::mt19937 engine;

  std::vector<double>& column(std::size_t c) { return table.columns[c]; }
  std::size_t rows() const { return table.columns[0].size(); }
  std::size_t below(std::size_t n) { return engine() % n; }
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); }
  // a row in the middle half that moves at no less than a third of the fastest
  std::size_t moving_row() {
    double fastest = 0.0;
    for (double v : table.columns[3]) fastest = std::max(fastest, std::fabs(v));
    for (int tries = 0; tries < 1000; ++tries) {
      std::size_t const row = rows() / 4 + below(rows() / 2);
      if (std::fabs(table.columns[3][row]) > fastest / 3.0) return row;
    }
    return rows() / 2;
  }
};

enum class Drive { sines, trapezes, slide };

// gravity, friction and inertia of random size on one of three motions; the slide is prismatic, in m
inline DrawnRecording draw_recording(unsigned number) {
  DrawnRecording drawn;
  drawn.engine.seed(7919u * number + 17u);
  auto const one_of = [&](std::vector<double> const& values) { return values[drawn.below(values.size())]; };
  auto const drive = static_cast<Drive>(drawn.below(3));
  drawn.rate_hz = one_of({60, 125, 200, 400, 800, 1000, 2500});
  double const seconds = one_of({7, 15, 31}),
               reach = drive == Drive::slide ? one_of({0.1, 0.4}) : one_of({0.2, 0.8, 2.0});
  drawn.encoder_step = one_of({0.0, 1e-6, 7e-5, 1e-3}) * reach;
  double const inertia = drawn.between(0.02, 2.0), viscous = drawn.between(0.1, 3.0), coulomb = drawn.between(0.2, 4.0);
  double const gravity = drive == Drive::slide ? 0.0 : drawn.between(0.0, 3.0), noise = one_of({0.005, 0.02, 0.05});
  double const phase = drawn.between(0.0, 6.28), w = drawn.between(1.2, 3.0), period = drawn.between(1.5, 3.5);
  std::normal_distribution<double> normal;
  auto const n = static_cast<std::size_t>(seconds * drawn.rate_hz);
  auto& table = drawn.table;
  table.path = "/data/drawn.csv";
  table.names = {"t_s", "q_rad", "tau_Nm", "qd_radps", "r_rad"};
  table.columns.assign(5, {});
  std::vector<double> q(n), dq(n), ddq(n), torque(n);
  for (std::size_t i = 0; i < n; ++i) {
    double const t = static_cast<double>(i) / drawn.rate_hz;
    if (drive == Drive::trapezes) {  // to and fro with smooth ends: the speed is a clipped sine
      double const x = 2.0 * std::numbers::pi * t / period + phase, steep = std::tanh(3.0 * std::sin(x));
      dq[i] = reach * steep * 2.0 / period;
      ddq[i] = reach * 2.0 / period * (1.0 - steep * steep) * 3.0 * std::cos(x) * 2.0 * std::numbers::pi / period;
      q[i] = i == 0 ? 0.3 * reach : q[i - 1] + 0.5 * (dq[i] + dq[i - 1]) / drawn.rate_hz;
    } else {
      q[i] = reach * (std::sin(w * t + phase) + 0.35 * std::sin(2.7 * w * t) + 0.1 * std::sin(5.1 * w * t + 1.0));
      dq[i] =
          reach * w * (std::cos(w * t + phase) + 0.945 * std::cos(2.7 * w * t) + 0.51 * std::cos(5.1 * w * t + 1.0));
      ddq[i] =
          -reach * w * w * (std::sin(w * t + phase) + 2.55 * std::sin(2.7 * w * t) + 2.6 * std::sin(5.1 * w * t + 1.0));
    }
    torque[i] =
        inertia * ddq[i] + viscous * dq[i] + coulomb * std::tanh(dq[i] / (0.01 * reach)) + gravity * std::sin(q[i]);
  }
  double rms = 0.0;
  for (double one : torque) rms += one * one;
  rms = std::sqrt(rms / static_cast<double>(n));
  double const late = drawn.between(0.0, 0.02);  // of the loop
  for (std::size_t i = 0; i < n; ++i) {
    double const step = drawn.encoder_step;
    table.columns[0].push_back(static_cast<double>(i) / drawn.rate_hz);
    table.columns[1].push_back(step > 0.0 ? step * std::round(q[i] / step) : q[i]);
    table.columns[2].push_back(torque[i] + noise * rms * normal(drawn.engine));
    table.columns[3].push_back(dq[i]);
    table.columns[4].push_back(q[i] + late * dq[i]);
    table.line_of_row.push_back(static_cast<std::int64_t>(i) + 2);
  }
  drawn.options = sample_options();
  drawn.options.columns["reference"] = "r_rad";
  return drawn;
}

struct FaultKind {
  char const* name;
  std::vector<FindingKind> told_as;  // any of them
  std::function<void(DrawnRecording&)> put;
  std::vector<std::string> written{};  // keys of the job
};

inline std::vector<FaultKind> const& fault_kinds() {
  using enum FindingKind;
  using R = DrawnRecording;
  constexpr double turn = 2.0 * std::numbers::pi;
  auto const with_velocity = [](R& r) { r.options.columns["velocity"] = "qd_radps"; };
  static std::vector<FaultKind> const kinds{
      {"wraps at a turn",
       {position_wraps},
       [](R& r) {
         double const times = 2.5 * turn /
                              (*std::max_element(r.column(1).begin(), r.column(1).end()) -
                               *std::min_element(r.column(1).begin(), r.column(1).end()));
         for (double& q : r.column(1)) q = times * q - turn * std::floor(times * q / turn);
         r.options.columns.erase("reference");
       }},
      {"single wrong rows",
       {single_wrong_rows},
       [](R& r) {
         double const away = 3.0 * (range_of(r.column(1)));
         for (int k = 0; k < 3; ++k) r.column(1)[r.moving_row()] += away;
       }},
      {"zero set anew",
       {position_jumps},
       [](R& r) {
         double const away = r.between(0.2, 0.6) * range_of(r.column(1));
         for (std::size_t i = r.moving_row(); i < r.rows(); ++i) r.column(1)[i] += away;
       }},
      {"repeated rows",
       {rows_repeated},
       [](R& r) {
         for (std::size_t row = 10; row + 12 < r.rows(); row += 50 + r.below(80))
           for (std::size_t k = row, end = row + 1 + r.below(4); k < end; ++k)
             for (std::size_t c : {1u, 2u, 3u}) r.column(c)[k] = r.column(c)[row - 1];
       }},
      {"two publishers",
       {rows_interleaved},
       [](R& r) {
         double const elsewhere = r.between(0.5, 2.0) * range_of(r.column(1));
         for (std::size_t i = 0; i < r.rows(); i += 2) r.column(1)[i] = elsewhere;
       }},
      {"torque spikes",
       {torque_spikes},
       [](R& r) {
         double const most = range_of(r.column(2)) * r.between(8.0, 100.0);
         for (int k = 0; k < 2; ++k) r.column(2)[r.moving_row()] = k ? most : -most;
       }},
      {"unsigned register",
       {unsigned_register},
       [](R& r) {
         double const unit = range_of(r.column(2)) / 5000.0;
         r.options.torque_per_unit = {unit};
         for (double& torque : r.column(2)) {
           double const counts = std::round(torque / unit);
           torque = counts >= 0.0 ? counts : counts + 65536.0;
         }
       },
       {"torque_per_unit"}},
      {"torque magnitude",
       {torque_without_sign},
       [](R& r) {
         for (double& torque : r.column(2)) torque = std::fabs(torque);
       }},
      {"torque off for 2 s",
       {torque_switched_off},
       [](R& r) {
         std::size_t const from = r.moving_row();
         for (std::size_t i = from; i < std::min(r.rows(), from + static_cast<std::size_t>(2.0 * r.rate_hz)); ++i)
           r.column(2)[i] = 0.0;
       }},
      {"rows out of order",
       {rows_out_of_order},
       [](R& r) {
         for (int k = 0; k < 20; ++k) {
           std::size_t const row = 5 + r.below(r.rows() - 10);
           for (auto& column : r.table.columns) std::swap(column[row], column[row + 1]);
         }
       }},
      {"milliseconds",
       {time_unit},
       [](R& r) {
         r.table.names[0] = r.options.columns["time"] = "time_ms";
         for (double& t : r.column(0)) t *= 1e3;
       }},
      {"bursts",
       {stamps_of_arrival},
       [](R& r) {
         std::size_t const together = 4 + r.below(12);
         for (std::size_t i = 0; i < r.rows(); ++i)
           r.column(0)[i] = static_cast<double>((i / together + 1) * together) / r.rate_hz +
                            2e-2 / r.rate_hz * static_cast<double>(i % together);
       }},
      {"clock set by 3 s",
       {clock_was_set},
       [](R& r) {
         for (std::size_t i = r.moving_row(); i < r.rows(); ++i) r.column(0)[i] += 3.0;
       }},
      {"velocity magnitude",
       {velocity_contradicts, velocity_factor},
       [=](R& r) {
         with_velocity(r);
         for (double& v : r.column(3)) v = std::fabs(v);
       }},
      {"velocity in rpm",
       {velocity_factor},
       [=](R& r) {
         with_velocity(r);
         for (double& v : r.column(3)) v *= 60.0 / turn;
       }},
      {"velocity 25 ms late",
       {velocity_late},
       [=](R& r) {
         with_velocity(r);
         auto const rows = static_cast<std::size_t>(std::max(2.0, std::round(0.025 * r.rate_hz)));
         for (std::size_t i = r.rows(); i-- > rows;) r.column(3)[i] = r.column(3)[i - rows];
       }},
      {"velocity of another joint",
       {velocity_contradicts},
       [=](R& r) {
         with_velocity(r);
         double const w = r.between(0.7, 5.0);
         for (std::size_t i = 0; i < r.rows(); ++i) r.column(3)[i] = std::cos(w * r.column(0)[i]);
       }},
      {"reference in degrees",
       {reference_factor},
       [](R& r) {
         for (double& q : r.column(4)) q *= 360.0 / turn;
       }},
      {"reference with the other sign",
       {reference_factor},
       [](R& r) {
         for (double& q : r.column(4)) q = -q;
       }},
      {"position in degrees beside a reference in rad",
       {position_factor},
       [](R& r) {
         for (double& q : r.column(1)) q *= 360.0 / turn;
       }},
      {"standstill",
       {standstill},
       [](R& r) {
         std::normal_distribution<double> normal;
         for (double& q : r.column(1)) q = 0.3 + 1e-4 * normal(r.engine);
       }},
  };
  return kinds;
}

}  // namespace torquescope::health_test
