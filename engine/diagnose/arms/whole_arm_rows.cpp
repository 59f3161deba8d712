#include "engine/diagnose/arms/whole_arm_rows.hpp"

#include <algorithm>
#include <numeric>

namespace torquescope {
namespace {

Eigen::Index moving_rows(RecordedRows const& rows) {
  return std::accumulate(rows.moving.begin(), rows.moving.end(), Eigen::Index{0},
                         [](Eigen::Index sum, JointRows const& joint) { return sum + joint.torque.size(); });
}

std::vector<LawPlace> places_of(std::vector<WholeArmLaw> const& laws) {
  std::vector<LawPlace> places;
  Eigen::Index first = 0;
  for (WholeArmLaw const& law : laws) {
    places.push_back({law.effect, law.joint, first, law.columns.front().cols()});
    first += places.back().count;
  }
  return places;
}

Eigen::Index columns_of(std::vector<LawPlace> const& places) {
  return places.empty() ? 0 : places.back().first + places.back().count;
}

// rows of one recording, joint after joint, below `first`
void put_rows(WholeArmRows& all, Eigen::Index first, ArmModel const& model, Eigen::VectorXd const& noise,
              RecordedRows const& rows, std::vector<WholeArmLaw> const& laws, ParallelFilter const& filter) {
  for (std::size_t j = 0; j < rows.moving.size(); ++j) {
    JointRows const& joint = rows.moving[j];
    Eigen::Index const count = joint.torque.size();
    double const per_noise = 1.0 / noise[static_cast<Eigen::Index>(j)];
    auto const& own = model.parameters_of(j);
    for (std::size_t c = 0; c < own.size(); ++c)
      all.model.col(own[c]).segment(first, count) = per_noise * joint.columns.col(static_cast<Eigen::Index>(c));
    all.torque.segment(first, count) = per_noise * joint.torque;
    for (std::size_t l = 0; l < laws.size(); ++l)
      all.laws.block(first, all.places[l].first, count, all.places[l].count) =
          per_noise * filter.apply_columns(laws[l].columns[j])(joint.instant, Eigen::all);
    for (Eigen::Index i = 0; i < count; ++i)
      all.rows[static_cast<std::size_t>(first + i)] = {j, joint.instant[static_cast<std::size_t>(i)], joint.time_s[i]};
    first += count;
  }
}

std::vector<Eigen::Index> by_instant(std::vector<ArmRow> const& rows, RowBlock const& recording) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(recording.size()));
  std::iota(order.begin(), order.end(), recording.from);
  auto const row = [&](Eigen::Index i) -> ArmRow const& { return rows[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return row(a).instant < row(b).instant; });
  return order;
}

// rows are in the order of time
void add_stretches(WholeArmRows& all, std::size_t recording, RowBlock const& rows, RecordedRows const& of,
                   double noise_correlation) {
  auto const at = [&](Eigen::Index i) -> ArmRow const& { return all.rows[static_cast<std::size_t>(i)]; };
  if (rows.size() == 0) return;
  double const period = 1.0 / of.kept_rate_hz;
  double const start = at(rows.from).time_s - static_cast<double>(at(rows.from).instant) * period;
  Eigen::Index next = rows.from;
  for (auto const& instants : equal_blocks(of.instants, stretches_per_recording)) {
    Eigen::Index const from = next;
    while (next < rows.to && at(next).instant < instants.to) ++next;
    auto const time = [&](Eigen::Index instant) { return start + static_cast<double>(instant) * period; };
    all.stretches.push_back({recording, {from, next}, time(instants.from), time(instants.to), noise_correlation});
  }
}

}  // namespace

WholeArmRows whole_arm_rows(ArmModel const& model, Eigen::VectorXd const& parameters, Eigen::VectorXd const& noise,
                            std::span<RecordedArm const> recordings, ArmFilter const& filter,
                            std::span<Effect const* const> wanted, int threads) {
  std::vector<RecordedRows> rows;
  std::vector<std::vector<WholeArmLaw>> laws;
  std::vector<RowBlock> of_recording;
  Eigen::Index n = 0;
  for (auto const& recording : recordings) {
    auto const motion = motion_of(recording, filter);
    rows.push_back(rows_of(model, recording, motion, filter));
    laws.push_back(whole_arm_laws(model, parameters, motion, wanted, threads));
    of_recording.push_back({n, n + moving_rows(rows.back())});
    n = of_recording.back().to;
  }
  WholeArmRows all;
  all.places = places_of(laws.front());
  all.model.setZero(n, static_cast<Eigen::Index>(model.size()));
  all.laws.resize(n, columns_of(all.places));
  all.torque.resize(n);
  all.rows.resize(static_cast<std::size_t>(n));
  std::vector<Eigen::Index> order;
  std::vector<double> noise_correlation;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Recording const& first = recordings[k].joints.front();
    ParallelFilter const parallel(filter.options, first.rate_hz, first.position.size(), filter.section);
    put_rows(all, of_recording[k].from, model, noise, rows[k], laws[k], parallel);
    noise_correlation.push_back(parallel.neighbour_correlation());
    auto const own = by_instant(all.rows, of_recording[k]);
    order.insert(order.end(), own.begin(), own.end());
  }
  all.model = all.model(order, Eigen::all).eval();
  all.laws = all.laws(order, Eigen::all).eval();
  all.torque = all.torque(order).eval();
  std::vector<ArmRow> sorted;
  for (Eigen::Index const i : order) sorted.push_back(all.rows[static_cast<std::size_t>(i)]);
  all.rows = std::move(sorted);
  for (std::size_t k = 0; k < rows.size(); ++k) add_stretches(all, k, of_recording[k], rows[k], noise_correlation[k]);
  return all;
}

}  // namespace torquescope
