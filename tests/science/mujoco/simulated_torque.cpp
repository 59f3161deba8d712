// The user's own simulator, for the example: what torque does this MuJoCo model need for the recorded motion?
//
// simulated_torque MODEL.xml IN.csv OUT.csv
//
// In, out    columns t_s (even steps), ..., position third; OUT.csv is IN.csv with a last column tau_sim_Nm
// Motion     cubic least squares over 17 neighbours (Savitzky, Golay 1964): position, velocity, acceleration in the
//            middle
// Torque     mj_inverse of a model with one hinge
// Exit code  0; 64 usage; 1 with a message
// Knows      nothing of Torquescope: its only tie to it is the column
#include <mujoco/mujoco.h>

#include <array>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Rows {
  std::string header;
  std::vector<std::string> lines;
  std::vector<double> time, position;
};

Rows read(char const* path) {
  std::ifstream file(path);
  Rows rows;
  if (!std::getline(file, rows.header)) throw std::runtime_error(std::string("cannot read ") + path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::array<std::string, 3> first;
    for (auto& cell : first) std::getline(cells, cell, ',');
    rows.time.push_back(std::stod(first[0]));
    rows.position.push_back(std::stod(first[2]));
    rows.lines.push_back(std::move(line));
  }
  if (rows.lines.size() < 100) throw std::runtime_error(std::string("too few rows in ") + path);
  return rows;
}

struct State {
  double q, v, a;
};

// cubic through samples k-m ... k+m; at the ends the nearest whole window
State smoothed(std::vector<double> const& q, std::size_t k, double step_s) {
  constexpr int m = 8;
  auto const last = static_cast<int>(q.size()) - 1 - m;
  int const centre = std::min(std::max(static_cast<int>(k), m), last);
  double s2 = 0.0, s4 = 0.0, s6 = 0.0, y0 = 0.0, y1 = 0.0, y2 = 0.0, y3 = 0.0;
  for (int i = -m; i <= m; ++i) {
    double const x = i, y = q[static_cast<std::size_t>(centre + i)];
    s2 += x * x, s4 += x * x * x * x, s6 += x * x * x * x * x * x;
    y0 += y, y1 += x * y, y2 += x * x * y, y3 += x * x * x * y;
  }
  constexpr double n = 2 * m + 1;
  double const c2 = (n * y2 - s2 * y0) / (n * s4 - s2 * s2), c0 = (y0 - s2 * c2) / n;
  double const c3 = (s2 * y3 - s4 * y1) / (s2 * s6 - s4 * s4), c1 = (y1 - s4 * c3) / s2;
  double const x = static_cast<int>(k) - centre;
  return {c0 + x * (c1 + x * (c2 + x * c3)), (c1 + x * (2 * c2 + 3 * x * c3)) / step_s,
          (2 * c2 + 6 * x * c3) / (step_s * step_s)};
}

template <class Item>
using Owned = std::unique_ptr<Item, void (*)(Item*)>;

int run(char const* model_path, char const* in, char const* out) {
  std::array<char, 1000> problem{};
  Owned<mjModel> const model(mj_loadXML(model_path, nullptr, problem.data(), problem.size()), mj_deleteModel);
  if (!model) throw std::runtime_error(problem.data());
  if (model->nv != 1) throw std::runtime_error("the model has to have one joint");
  Owned<mjData> const data(mj_makeData(model.get()), mj_deleteData);

  Rows const rows = read(in);
  double const step_s = (rows.time.back() - rows.time.front()) / static_cast<double>(rows.time.size() - 1);
  std::ofstream file(out);
  file.precision(10);
  file << rows.header << ",tau_sim_Nm\n";
  for (std::size_t k = 0; k < rows.lines.size(); ++k) {
    State const now = smoothed(rows.position, k, step_s);
    data->qpos[0] = now.q;
    data->qvel[0] = now.v;
    data->qacc[0] = now.a;
    mj_inverse(model.get(), data.get());
    file << rows.lines[k] << ',' << data->qfrc_inverse[0] << '\n';
  }
  file.close();
  if (!file) throw std::runtime_error(std::string("cannot write ") + out);
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fputs("usage: simulated_torque MODEL.xml IN.csv OUT.csv\n", stderr);
    return 64;
  }
  return run(argv[1], argv[2], argv[3]);
} catch (std::exception const& failure) {
  std::fprintf(stderr, "simulated_torque: %s\n", failure.what());
  return 1;
}
