#include "stranger/case_writer.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace stranger {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File open(std::filesystem::path const& path) {
  File file{std::fopen(path.c_str(), "w"), &std::fclose};
  if (!file) throw std::runtime_error("cannot write " + path.string());
  return file;
}

double position_unit(Case const& which) {
  if (which.instruments.position == PositionWord::degrees) return 0.017453292519943295;
  if (which.instruments.position == PositionWord::counts) return 1 / which.instruments.counts_per_unit;
  return 1;
}

double torque_unit(Case const& which) {
  if (which.instruments.torque == TorqueWord::amperes) return find_rig(which.rig).torque_limit / 23;
  if (which.instruments.torque == TorqueWord::permille) return find_rig(which.rig).torque_limit / 1000;
  return 1;
}

void write_recording(Case const& which, std::vector<Sample> const& samples, std::filesystem::path const& path) {
  Instruments const& by = which.instruments;
  auto const file = open(path);
  std::FILE* out = file.get();
  if (by.time != TimeWord::none) std::fputs("t,", out);
  if (by.reference) std::fputs("target,", out);
  std::fputs("actual,", out);
  if (by.velocity) std::fputs("tacho,", out);
  std::fputs("torque\n", out);
  double const unit = position_unit(which);
  bool const counts = by.position == PositionWord::counts;
  for (auto const& s : samples) {
    if (by.time == TimeWord::seconds) std::fprintf(out, "%.6f,", s.t);
    if (by.time == TimeWord::epoch) std::fprintf(out, "%.6f,", 1763800000.25 + s.t);
    if (by.reference) std::fprintf(out, counts ? "%.0f," : "%.8g,", s.reference / unit);
    std::fprintf(out, counts ? "%.0f," : "%.8g,", s.position / unit);
    if (by.velocity) std::fprintf(out, "%.6g,", s.velocity / unit);
    std::fprintf(out, by.torque == TorqueWord::permille ? "%.0f\n" : "%.6g\n", s.torque / torque_unit(which));
  }
}

// what the scorer may see: SI, and the torque no rigid-body model has
void write_truth_recording(std::vector<Sample> const& samples, std::filesystem::path const& path) {
  auto const file = open(path);
  std::fputs("t,reference,position,torque,unexplained\n", file.get());
  for (auto const& s : samples)
    std::fprintf(file.get(), "%.6f,%.9g,%.9g,%.9g,%.9g\n", s.t, s.reference, s.position, s.torque, s.unexplained);
}

std::string quoted(std::vector<std::string> const& words) {
  std::string text;
  for (auto const& word : words) text += (text.empty() ? "\"" : ", \"") + word + "\"";
  return "[" + text + "]";
}

void write_job(Case const& which, std::filesystem::path const& path) {
  Instruments const& by = which.instruments;
  Rig const rig = find_rig(which.rig);
  std::ofstream out{path};
  out.precision(17);
  out << "[experiment]\nname = \"" << which.name
      << "\"\nseed = 11\n\n[recording]\ntrain = \"train.csv\"\nvalidate = \"unseen.csv\"\n";
  out << "columns = {";
  if (by.time != TimeWord::none) out << "time = \"t\", ";
  if (by.reference) out << "reference = \"target\", ";
  if (by.velocity) out << "velocity = \"tacho\", ";
  out << "position = \"actual\", torque = \"torque\"}\n";
  if (by.time == TimeWord::none) out << "rate_hz = " << by.log_hz << "\n";
  if (position_unit(which) != 1) out << "position_per_unit = " << position_unit(which) << "\n";
  if (torque_unit(which) != 1) out << "torque_per_unit = " << torque_unit(which) << "\n";
  Pipeline const& filter = which.pipeline;
  out << "\n[filter]\ncutoff_hz = " << filter.cutoff_hz << "\nparallel_cutoff_hz = " << filter.parallel_cutoff_hz
      << "\ndecimate_to_hz = " << filter.decimate_to_hz << "\n\n[model]\njoint = \""
      << (rig.slides ? "prismatic" : "revolute") << "\"\nterms = " << quoted(rig.terms) << "\n\n[diagnose]\n";
}

void write_truth(Case const& which, std::filesystem::path const& path) {
  Pipeline const& filter = which.pipeline;
  std::ofstream out{path};
  out << "{\"case\": \"" << which.name << "\", \"kind\": \"" << which.kind << "\", \"rig\": \"" << which.rig
      << "\",\n \"terms\": " << quoted(find_rig(which.rig).terms) << ",\n \"hang\": " << find_rig(which.rig).hang
      << ", \"log_hz\": " << which.instruments.log_hz << ", \"cutoff_hz\": " << filter.cutoff_hz
      << ", \"parallel_cutoff_hz\": " << filter.parallel_cutoff_hz << ", \"decimate_to_hz\": " << filter.decimate_to_hz
      << ",\n \"laws\": [";
  for (std::size_t k = 0; k < which.laws.size(); ++k) {
    auto const& law = which.laws[k];
    out << (k ? ",\n   " : "") << "{\"name\": \"" << law.name << "\", \"form\": \"" << law.form << "\", \"values\": [";
    for (std::size_t i = 0; i < law.values.size(); ++i) out << (i ? ", " : "") << law.values[i];
    out << "]";
    if (k < which.places.size() && !which.places[k].axis.empty())
      out << ", \"place\": {\"axis\": \"" << which.places[k].axis << "\", \"from\": " << which.places[k].from
          << ", \"to\": " << which.places[k].to << "}";
    out << "}";
  }
  out << "],\n \"acceptable\": " << quoted(which.acceptable) << "}\n";
}

}  // namespace

void write_case(Case const& which, std::filesystem::path const& folder, Options const& options) {
  std::filesystem::create_directories(folder / "truth");
  for (bool validation : {false, true}) {
    auto const samples = record(which, validation, options);
    std::string const name = validation ? "unseen.csv" : "train.csv";
    write_recording(which, samples, folder / name);
    write_truth_recording(samples, folder / "truth" / name);
  }
  write_job(which, folder / "job.toml");
  write_truth(which, folder / "truth" / "truth.json");
}

}  // namespace stranger
