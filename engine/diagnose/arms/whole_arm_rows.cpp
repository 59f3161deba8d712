#include "engine/diagnose/arms/whole_arm_rows.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

namespace torquescope {
namespace {

RowGrid grid_of(Strip const& strip, double begins_s) {
  auto const& filter = *strip.filters->effects;
  double const period_s = static_cast<double>(strip.rows_apart) / filter.kept_rate_hz();
  Eigen::VectorXd const times = filter.pick(strip.motion.time_s);
  return {(filter.kept_samples() + strip.rows_apart - 1) / strip.rows_apart, begins_s + times[0], period_s,
          filter.neighbour_correlation(strip.rows_apart)};
}

void add_strip(RowsOfJoint& to, Strip const& strip, double begins_s) {
  RowGrid const grid = grid_of(strip, begins_s);
  for (Eigen::Index const row : strip.rows) {
    Eigen::Index const instant = row / strip.rows_apart;
    to.rows.push_back(
        {to.joint, to.recordings.size(), instant, grid.start_s + static_cast<double>(instant) * grid.period_s});
  }
  to.recordings.push_back(grid);
}

// of the rows in the order of time
std::vector<std::size_t> by_instant(std::vector<ArmRow> const& rows) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(rows[a].recording, rows[a].instant) < std::pair(rows[b].recording, rows[b].instant);
  });
  return order;
}

void add_stretches(WholeArmRows& all) {
  auto const at = [&](Eigen::Index i) -> ArmRow const& { return all.rows[static_cast<std::size_t>(i)]; };
  Eigen::Index next = 0;
  for (std::size_t k = 0; k < all.recordings.size(); ++k) {
    RowGrid const& grid = all.recordings[k];
    auto const time = [&](Eigen::Index instant) { return grid.start_s + static_cast<double>(instant) * grid.period_s; };
    for (auto const& instants : equal_blocks(grid.instants, stretches_per_recording)) {
      Eigen::Index const from = next;
      while (next < std::ssize(all.rows) && at(next).recording == k && at(next).instant < instants.to) ++next;
      all.stretches.push_back({k, {from, next}, time(instants.from), time(instants.to)});
    }
  }
}

}  // namespace

std::vector<EffectPlace> effect_places(std::vector<WholeArmEffect> const& effects) {
  std::vector<EffectPlace> places;
  for (WholeArmEffect const& asked : effects)
    places.push_back({asked.effect, asked.joint, effect_columns(places), asked.columns.front().cols()});
  return places;
}

Eigen::Index effect_columns(std::vector<EffectPlace> const& places) {
  return places.empty() ? 0 : places.back().first + places.back().count;
}

void give_whole_arm_effects(std::vector<Recording>& joints, std::vector<WholeArmEffect> const& effects) {
  for (std::size_t j = 0; j < joints.size() && !effects.empty(); ++j) {
    Eigen::MatrixXd columns(joints[j].position.size(), effect_columns(effect_places(effects)));
    Eigen::Index first = 0;
    for (WholeArmEffect const& asked : effects) {
      columns.middleCols(first, asked.columns[j].cols()) = asked.columns[j];
      first += asked.columns[j].cols();
    }
    GivenSignals given = joints[j].given ? *joints[j].given : GivenSignals{};
    given.effects.push_back({whole_arm_effects_name, std::move(columns)});
    joints[j].given = std::make_shared<GivenSignals const>(std::move(given));
  }
}

ArmRowsOfJoint rows_of_joint(DecidedJoint const& joint, Eigen::Index effects) {
  SharedEffect of_effects{whole_arm_effects_name, joint.shared.instead_of, {}, effects};
  of_effects.places.resize(static_cast<std::size_t>(effects));
  std::iota(of_effects.places.begin(), of_effects.places.end(), Eigen::Index{0});
  ArmRowsOfJoint made;
  made.training.joint = joint.joint;
  made.training.model = shared_rows(*joint.model.fitted, joint.shared);
  made.training.effects = shared_rows(*joint.model.fitted, of_effects).shared;
  made.training.torque_energy = joint.strips.training_energy;
  std::size_t recording = 0;
  for (Strip const& strip : *joint.strips.training) add_strip(made.training, strip, joint.begins_s[recording++]);
  for (Strip const& strip : joint.strips.validation) {
    RowsOfJoint one{joint.joint, predicted_rows(joint.model, strip, joint.shared).rows,
                    predicted_rows(joint.model, strip, of_effects).rows.shared};
    one.torque_energy = on_rows(strip, strip.torque).squaredNorm();
    add_strip(one, strip, joint.begins_s[recording++]);
    made.validation.push_back(std::move(one));
  }
  return made;
}

WholeArmRows whole_arm_rows(std::vector<RowsOfJoint const*> const& joints, std::vector<Eigen::Index> const& own_columns,
                            Eigen::VectorXd const& noise, std::vector<EffectPlace> const& places) {
  WholeArmRows all;
  all.places = places;
  if (joints.empty()) return all;
  all.recordings = joints.front()->recordings;
  std::vector<ArmRow> rows;
  for (auto const* joint : joints) rows.insert(rows.end(), joint->rows.begin(), joint->rows.end());
  auto const order = by_instant(rows);
  std::vector<Eigen::Index> place(rows.size());  // of each row in the order of time
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = static_cast<Eigen::Index>(i);
    all.rows.push_back(rows[order[i]]);
  }
  Eigen::Index const n = std::ssize(rows), shared = joints.front()->model.shared.cols();
  all.model.setZero(n, shared + std::accumulate(own_columns.begin(), own_columns.end(), Eigen::Index{0}));
  all.effects.resize(n, effect_columns(places));
  all.torque.resize(n);
  Eigen::Index own = shared;
  auto first = place.begin();
  for (std::size_t i = 0; i < joints.size(); own += own_columns[i++]) {
    RowsOfJoint const& joint = *joints[i];
    double const per_noise = 1.0 / noise[static_cast<Eigen::Index>(joint.joint)];
    std::vector<Eigen::Index> const at(first, first + std::ssize(joint.rows));
    first += std::ssize(joint.rows);
    all.model(at, Eigen::seqN(0, shared)) = per_noise * joint.model.shared;
    all.model(at, Eigen::seqN(own, joint.model.own.cols())) = per_noise * joint.model.own;
    all.effects(at, Eigen::all) = per_noise * joint.effects;
    all.torque(at) = per_noise * joint.model.torque;
    all.torque_energy += joint.torque_energy;
  }
  add_stretches(all);
  return all;
}

}  // namespace torquescope
