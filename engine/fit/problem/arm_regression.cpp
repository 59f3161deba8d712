#include "engine/fit/problem/arm_regression.hpp"

#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/fit/problem/unequal_rates.hpp"

namespace torquescope {
namespace {

std::vector<JointRows> const& chosen(RecordedRows const& rows, ArmRowChoice choice) {
  return choice == ArmRowChoice::moving ? rows.moving : rows.others;
}

Eigen::Index count_rows(std::span<RecordedRows const> recordings, ArmRowChoice choice) {
  Eigen::Index n = 0;
  for (auto const& recording : recordings)
    for (auto const& joint : chosen(recording, choice)) n += joint.torque.size();
  return n;
}

}  // namespace

RegressionData stack_rows(std::span<RecordedRows const> recordings, ArmRowChoice choice, ArmModel const& model,
                          Eigen::VectorXd const& scale, Section const& filter) {
  TORQUESCOPE_EXPECT(!recordings.empty() && static_cast<std::size_t>(scale.size()) == model.joints());
  RegressionData data;
  data.columns = model.columns();
  data.kept_rate_hz = recordings.front().kept_rate_hz;
  data.first_row = {0};
  auto& arm = data.arm.emplace(RegressionData::Arm{});
  arm.scale = scale;
  arm.first_instant = {0};
  arm.model = std::make_shared<ArmModel const>(model);
  arm.gain_column = model.gain_columns();
  Eigen::Index const n = count_rows(recordings, choice);
  data.phi.setZero(n, static_cast<Eigen::Index>(model.size()));
  for (auto signal :
       {&RegressionData::tau, &RegressionData::time_s, &RegressionData::q, &RegressionData::dq, &RegressionData::ddq})
    (data.*signal).resize(n);
  arm.instant.reserve(static_cast<std::size_t>(n));

  for (auto const& recording : recordings) {
    check_kept_rate(recording.recording, recording.kept_rate_hz, recordings.front().recording, data.kept_rate_hz,
                    filter);
    for (std::size_t j = 0; j < model.joints(); ++j) {
      auto const& rows = chosen(recording, choice)[j];
      Eigen::Index const first = data.first_row.back(), count = rows.torque.size();
      double const per_noise = 1.0 / scale[static_cast<Eigen::Index>(j)];
      auto const& own = model.parameters_of(j);
      for (std::size_t c = 0; c < own.size(); ++c)
        data.phi.col(own[c]).segment(first, count) = per_noise * rows.columns.col(static_cast<Eigen::Index>(c));
      data.tau.segment(first, count) = per_noise * rows.torque;
      data.time_s.segment(first, count) = rows.time_s;
      data.q.segment(first, count) = rows.q;
      data.dq.segment(first, count) = rows.dq;
      data.ddq.segment(first, count) = rows.ddq;
      for (auto const instant : rows.instant) arm.instant.push_back(arm.first_instant.back() + instant);
      arm.joint.push_back(j);
      data.first_row.push_back(first + count);
      data.recording_names.push_back(recording.recording);
      data.rate_hz.push_back(recording.rate_hz);
    }
    arm.first_instant.push_back(arm.first_instant.back() + recording.instants);
  }
  return data;
}

RegressionData with_stated_gains(RegressionData const& data) {
  TORQUESCOPE_EXPECT(data.arm.has_value());
  RegressionData stated = data;
  auto const gains = static_cast<Eigen::Index>(data.arm->gain_column.size());
  stated.phi.conservativeResize(Eigen::NoChange, data.parameters() - gains);
  stated.columns.resize(static_cast<std::size_t>(stated.parameters()));
  stated.arm->gain_column.clear();
  return stated;
}

Eigen::VectorXd unscaling_weights(RegressionData const& data) {
  TORQUESCOPE_EXPECT(data.arm.has_value());
  Eigen::VectorXd weights(data.rows());
  for (std::size_t k = 0; k < data.recordings(); ++k) {
    double const scale = data.arm->scale[static_cast<Eigen::Index>(data.arm->joint[k])];
    weights.segment(data.first_row[k], data.first_row[k + 1] - data.first_row[k]).setConstant(scale * scale);
  }
  return weights;
}

}  // namespace torquescope
