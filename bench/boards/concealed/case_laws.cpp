// The recordings can be trusted: accurate, reproducible, identifiable when clean, and of the stated kind when not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "concealed/case_writer.hpp"
#include "concealed/least_squares.hpp"
#include "concealed/low_pass.hpp"

namespace concealed {
namespace case_laws_test {

Case shortened(Case one_case, double train_s) {
  one_case.train_s = train_s;
  one_case.validate_s = std::min(one_case.validate_s, train_s);
  return one_case;
}

LoopRun training_run(Case const& one_case, Rig const& rig) {
  Excitation const motion = one_case.excitation(true);
  return run_closed_loop(rig, one_case.laws(), one_case.plan(motion, true));
}

TEST(ConcealedCases, HaveOneNameEach) {
  std::set<std::string> names;
  for (auto const& one_case : sealed_cases()) names.insert(one_case.name);
  EXPECT_EQ(names.size(), sealed_cases().size());
  EXPECT_THROW(sealed_case("nothing"), std::invalid_argument);
}

TEST(ConcealedCases, UseOtherFormsThanTheCatalogueInAThirdOfTheEffects) {
  double effects = 0.0, others = 0.0;
  for (auto const& one_case : sealed_cases()) {
    for (auto const& effect : one_case.effects) {
      effects += 1.0;
      others += effect.catalogue_form ? 0.0 : 1.0;
    }
  }
  EXPECT_GE(others, 0.3 * effects);
}

TEST(ConcealedCases, HalvingTheStepChangesLessThanAHundredthOfTheNoise) {
  for (auto const& one_case : sealed_cases()) {
    Case const brief = shortened(one_case, 20.0);
    StepError const error = step_error(brief, training_run(brief, brief.rig));
    EXPECT_LT(error.torque, 0.01) << one_case.name;
    EXPECT_LT(error.position, 0.01) << one_case.name;
  }
}

TEST(ConcealedCases, SameSeedSameBytes) {
  Case const brief = shortened(sealed_case("oak"), 6.0);
  auto const folder = std::filesystem::path(testing::TempDir()) / "concealed_bytes";
  std::string const one = write_case(brief, report_case(brief), folder / "one");
  std::string const two = write_case(brief, report_case(brief), folder / "two");
  EXPECT_EQ(one, two);
  Recording const first = report_case(brief).train, second = report_case(brief).train;
  EXPECT_EQ(first.position, second.position);
  EXPECT_EQ(first.torque, second.torque);
  Case other = brief;
  other.seed += 1;
  EXPECT_NE(report_case(other).train.torque, first.torque);
  std::filesystem::remove_all(folder);
}

TEST(ConcealedCases, JobAndRecordingDoNotNameWhatIsConcealed) {
  for (auto const& one_case : sealed_cases()) {
    std::string const job = job_text(one_case) + one_case.name;
    for (auto const& other : sealed_cases()) {
      for (auto const& effect : other.effects) {
        // a known weight is part of the baseline and of the job
        if (effect.name == "gravity" || effect.name.empty()) continue;
        EXPECT_EQ(job.find(effect.name), std::string::npos) << one_case.name << " tells " << effect.name;
      }
    }
  }
}

// exact signals: nothing is left but rounding
TEST(CleanRecords, LeaveNoResidualAtTheTruth) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Case const clean = shortened(clean_case(seed), 15.0);
    Baseline const& truth = clean.rig.joint.baseline;
    BaselineFit const fit = fit_baseline(training_run(clean, without_noise(clean.rig)).truth, truth.has_gravity());
    EXPECT_NEAR(fit.parameters.inertia / truth.inertia, 1.0, 1e-9);
    EXPECT_NEAR(fit.parameters.viscous / truth.viscous, 1.0, 1e-9);
    EXPECT_NEAR(fit.parameters.coulomb / truth.coulomb, 1.0, 1e-9);
    EXPECT_LT(rms(fit.residual), 1e-9 * truth.coulomb);
  }
}

// what a recording without noise shows, by the textbook: low-pass, central differences, reversals left out. Stated
// accuracy: half a per cent of inertia and Coulomb friction, one of viscous friction (it takes what differences lose)
TEST(CleanRecords, GiveTheParametersBackFromPositionAndTorqueAlone) {
  double const rate_hz = 1.0 / tick_s;
  for (char const* name : {"elbow", "wrist", "stage"}) {
    Case clean = clean_case(1);
    clean.rig = without_noise({joint_named(name), controller_named("cascade"), noise_named("none"), 0});
    clean.train = Recipe::mixed;
    clean.train_s = 31.0;
    Recording const recording = training_run(clean, clean.rig).recording;
    // the torque held from row k on belongs to the middle between rows k and k + 1
    std::size_t const n = recording.position.size() - 2;
    std::vector<double> v, a, sign, torque;
    for (std::size_t k = 1; k + 1 < n; ++k) {
      auto const& q = recording.position;
      v.push_back((q[k + 1] - q[k]) * rate_hz);
      a.push_back((q[k + 2] - q[k + 1] - q[k] + q[k - 1]) * 0.5 * rate_hz * rate_hz);
      sign.push_back(v.back() > 0.0 ? 1.0 : v.back() < 0.0 ? -1.0 : 0.0);
      torque.push_back(recording.torque[k]);
    }
    double const slow = 0.02 * clean.rig.joint.limits.speed;
    std::vector<char> keep(v.size(), 1);
    int const beside = 30;  // ticks: as long as the low-pass rings
    for (int k = 0; k < static_cast<int>(v.size()); ++k) {
      for (int j = std::max(0, k - beside); j < std::min(static_cast<int>(v.size()), k + beside); ++j) {
        if (std::abs(v[static_cast<std::size_t>(j)]) < slow) keep[static_cast<std::size_t>(k)] = 0;
      }
    }
    std::vector<std::vector<double>> columns(4);
    std::vector<double> y;
    auto const fv = low_passed(v, parallel_cutoff_hz, rate_hz), fa = low_passed(a, parallel_cutoff_hz, rate_hz);
    auto const fs = low_passed(sign, parallel_cutoff_hz, rate_hz), fy = low_passed(torque, parallel_cutoff_hz, rate_hz);
    for (std::size_t k = 0; k < v.size(); ++k) {
      if (!keep[k]) continue;
      columns[0].push_back(fa[k]);
      columns[1].push_back(fv[k]);
      columns[2].push_back(fs[k]);
      columns[3].push_back(1.0);
      y.push_back(fy[k]);
    }
    auto const fitted = least_squares(columns, y);
    Baseline const& truth = clean.rig.joint.baseline;
    EXPECT_NEAR(fitted[0] / truth.inertia, 1.0, 0.005) << name;
    EXPECT_NEAR(fitted[1] / truth.viscous, 1.0, 0.01) << name;
    EXPECT_NEAR(fitted[2] / truth.coulomb, 1.0, 0.005) << name;
  }
}

TEST(CleanRecords, SpreadOverJointsLoopsNoisesAndMotions) {
  std::set<std::string> joints, controllers, noises, motions;
  std::set<int> bits;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Case const clean = clean_case(seed);
    EXPECT_EQ(clean.expected_verdict(), "none");
    joints.insert(clean.rig.joint.name);
    controllers.insert(clean.rig.controller.name);
    noises.insert(clean.rig.noise.name);
    motions.insert(to_text(clean.train));
    bits.insert(clean.rig.encoder_bits);
  }
  EXPECT_EQ(joints.size(), 4u);
  EXPECT_EQ(controllers.size(), 5u);
  EXPECT_EQ(noises.size(), 3u);
  EXPECT_EQ(motions.size(), 3u);
  EXPECT_EQ(bits.size(), 4u);
}

TEST(TruthRegion, HoldsFourFifthsOfTheEnergyAndNotMuchMore) {
  Case const brief = shortened(sealed_case("alder"), 31.0);
  Truth const truth = training_run(brief, without_noise(brief.rig)).truth;
  for (auto const& region : truth_regions(truth, truth.added[0], brief.rig.joint.baseline)) {
    if (region.axis != "velocity" && region.axis != "time") continue;
    auto const& place = region.axis == "time" ? truth.t : truth.v;
    double inside = 0.0, all = 0.0;
    for (std::size_t k = 0; k < place.size(); ++k) {
      double const energy = truth.added[0][k] * truth.added[0][k];
      all += energy;
      for (auto const& [low, high] : region.intervals()) {
        if (place[k] >= low && place[k] < high) inside += energy;
      }
    }
    EXPECT_GE(inside, 0.8 * all) << region.axis;
    // a bin around rest can hold much
    EXPECT_LE(inside, 0.999 * all) << region.axis;
  }
}

TEST(TruthRegion, OfAStribeckRiseIsTheSlowPart) {
  Case const brief = shortened(sealed_case("alder"), 31.0);
  Truth const truth = training_run(brief, without_noise(brief.rig)).truth;
  for (auto const& region : truth_regions(truth, truth.added[0], brief.rig.joint.baseline)) {
    if (region.axis != "velocity") continue;
    auto const intervals = region.intervals();
    ASSERT_EQ(intervals.size(), 1u);
    EXPECT_LT(intervals[0].first, 0.0);
    EXPECT_GT(intervals[0].first, -0.1 * brief.rig.joint.limits.speed);
    EXPECT_GT(intervals[0].second, 0.0);
    EXPECT_LT(intervals[0].second, 0.1 * brief.rig.joint.limits.speed);
  }
}

}  // namespace case_laws_test
}  // namespace concealed
