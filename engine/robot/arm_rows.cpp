#include "engine/robot/arm_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"
#include "kernels/aligned_doubles.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

std::size_t place(Index i) { return static_cast<std::size_t>(i); }

// of a multiple of a right angle without the rounding that cos(pi / 2) has: kernels leave out products with 0
CosineSine cosine_sine(double angle) {
  double const quarters = angle / (std::numbers::pi / 2.0), cosine = std::cos(angle), sine = std::sin(angle);
  if (quarters != std::round(quarters)) return {cosine, sine};
  return {std::round(cosine), std::round(sine)};
}

kernels::ArmPlan plan_of(SerialChain const& chain, BaseParameters const& base,
                         std::span<FrictionColumns const> friction) {
  TORQUESCOPE_EXPECT(friction.size() == chain.joints.size());
  std::vector<kernels::ArmJoint> joints(chain.joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    auto const& from = chain.joints[j];
    auto const motion = from.kind == JointKind::revolute ? kernels::JointMotion::turns : kernels::JointMotion::slides;
    int own = 0;
    if (friction[j].viscous) own |= kernels::own_speed;
    if (friction[j].coulomb) own |= kernels::own_direction;
    if (friction[j].offset) own |= kernels::own_one;
    auto const twist = cosine_sine(from.alpha);
    joints[j] = {from.a, from.d, twist.cosine, twist.sine, from.offset, motion, 0, static_cast<std::uint8_t>(own)};
  }
  Index const n_links = numbers_per_link * chain.size();
  for (Index const column : base.columns()) {
    if (column < n_links)
      joints[place(column / numbers_per_link)].link_columns |=
          static_cast<std::uint16_t>(1U << (column % numbers_per_link));
    else if (!chain.is_coupled(column - n_links))
      joints[place(column - n_links)].own_columns |= kernels::own_acceleration;
  }
  return {std::move(joints), {chain.gravity.x(), chain.gravity.y(), chain.gravity.z()}};
}

std::vector<ArmColumn> columns_of(SerialChain const& chain, BaseParameters const& base, Index joint,
                                  FrictionColumns const& friction) {
  std::vector<ArmColumn> columns;
  for (Index k = 0; k < base.size(); ++k) {
    auto const& parameter = base.parameters()[place(k)];
    Index const motor = parameter.column - numbers_per_link * chain.size();
    if (motor >= 0 && chain.is_coupled(motor)) continue;
    if (parameter.first_row <= joint && joint <= parameter.last_row) columns.push_back({parameter.name, k});
  }
  std::string const number = std::to_string(joint + 1);
  auto const append = [&](bool wanted, char const* name) {
    if (wanted) columns.push_back({name + number, ArmColumn::of_the_joint});
  };
  append(friction.viscous, "viscous_");
  append(friction.coulomb, "coulomb_");
  append(friction.offset, "offset_");
  return columns;
}

}  // namespace

ArmRows::ArmRows(SerialChain const& chain, BaseParameters const& base, std::span<FrictionColumns const> friction)
    : plan_(plan_of(chain, base, friction)) {
  for (Index joint = 0; joint < chain.size(); ++joint) {
    columns_.push_back(columns_of(chain, base, joint, friction[place(joint)]));
    TORQUESCOPE_ENSURE(columns_.back().size() + 1 == plan_.row_width(place(joint)));
  }
}

template <class Take>
void ArmRows::for_each_block(std::span<JointSamples const> samples, Take const& take) const {
  TORQUESCOPE_EXPECT(place(joints()) == samples.size());
  auto const signals = signals_of(samples);
  std::size_t const n = samples.front().q.size();
  kernels::AlignedDoubles block(plan_.rows_before(plan_.size()));
  kernels::AlignedDoubles workspace(kernels::arm_rows_workspace_size(plan_));
  for (std::size_t first = 0; first < n; first += kernels::row_block_samples) {
    std::size_t const count = std::min(kernels::row_block_samples, n - first);
    kernels::arm_rows(plan_, signals.data(), first, count, block.data(), workspace.data());
    take(block.data(), first, count);
  }
}

void ArmRows::copy_columns(double const* block, Index joint, std::size_t count, Eigen::Ref<Eigen::MatrixXd> out) const {
  std::size_t const width = plan_.row_width(place(joint));
  double const* const from = block + plan_.rows_before(place(joint));
  for (Index c = 0; c < out.cols(); ++c)
    for (std::size_t t = 0; t < count; t += kernels::n_lanes)
      std::copy_n(from + (t / kernels::n_lanes * width + place(c)) * kernels::n_lanes,
                  std::min(kernels::n_lanes, count - t), out.col(c).data() + t);
}

Eigen::MatrixXd ArmRows::rows(std::span<JointSamples const> samples, Index joint) const {
  TORQUESCOPE_EXPECT(joint >= 0 && joint < joints());
  Eigen::MatrixXd rows(static_cast<Index>(samples.front().q.size()), static_cast<Index>(plan_.row_width(place(joint))));
  for_each_block(samples, [&](double const* block, std::size_t first, std::size_t count) {
    copy_columns(block, joint, count, rows.middleRows(static_cast<Index>(first), static_cast<Index>(count)));
  });
  return rows;
}

void ArmRows::fill(std::span<JointSamples const> samples, std::span<Eigen::MatrixXd> rows) const {
  TORQUESCOPE_EXPECT(rows.size() == samples.size());
  for_each_block(samples, [&](double const* block, std::size_t first, std::size_t count) {
    for (Index j = 0; j < joints(); ++j)
      copy_columns(block, j, count,
                   rows[place(j)].block(static_cast<Index>(first), 0, static_cast<Index>(count),
                                        static_cast<Index>(columns(j).size())));
  });
}

std::vector<kernels::JointSignals> signals_of(std::span<JointSamples const> samples) {
  std::vector<kernels::JointSignals> signals;
  for (auto const& joint : samples) {
    std::size_t const n = samples.front().q.size();
    TORQUESCOPE_EXPECT(joint.q.size() == n && joint.dq.size() == n && joint.ddq.size() == n && joint.tau.size() == n);
    TORQUESCOPE_EXPECT(joint.root_weight.empty() || joint.root_weight.size() == n);
    signals.push_back({joint.q.data(), joint.dq.data(), joint.ddq.data(), joint.tau.data(),
                       joint.root_weight.empty() ? nullptr : joint.root_weight.data()});
  }
  return signals;
}

}  // namespace torquescope
