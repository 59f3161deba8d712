#include "sticking/case_writer.hpp"

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sticking {
namespace {

class Text {
 public:
  explicit Text(std::filesystem::path const& path) : path_(path.string()), file_(std::fopen(path.c_str(), "w")) {
    if (!file_) throw std::runtime_error("cannot write " + path_);
  }
  Text& operator<<(std::string_view words) {
    std::fwrite(words.data(), 1, words.size(), file_.get());
    return *this;
  }
  Text& number(double x, int digits = 10) {
    std::fprintf(file_.get(), "%.*g", digits, x);
    return *this;
  }
  void close() {
    if (std::fclose(file_.release()) != 0) throw std::runtime_error("cannot write all of " + path_);
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

std::string kind_of(Case const& which) { return which.effect ? "single" : "clean"; }

void write_recording(Case const& which, bool is_other, std::filesystem::path const& path) {
  Recording const& recording = is_other ? which.other : which.train;
  Chance noise{which.at, is_other ? Purpose::other_noise : Purpose::train_noise};
  double const sigma = which.rig.reading.noise_share * which.torque_rms;
  Text out{path};
  out << "time_s,q,tau,q_ref\n";
  double row_number = 0.0;
  for (Row const& row : recording.rows) {
    out.number(row_number++ / which.rig.reading.log_hz, 8) << ",";
    out.number(row.position) << ",";
    out.number(row.torque + sigma * noise.normal(), 7) << ",";
    out.number(row.reference) << "\n";
  }
  out.close();
}

void write_job(Case const& which, std::filesystem::path const& path) {
  Smoothing const& smoothing = which.rig.smoothing;
  Text out{path};
  out << "[experiment]\nname = \"sticking_" << kind_of(which) << "_" << std::to_string(which.at.number)
      << "\"\nseed = " << std::to_string(1000 + which.at.number) << "\n\n[recording]\n"
      << "train = \"train.csv\"\nvalidate = \"validate.csv\"\n"
      << "columns = {time = \"time_s\", position = \"q\", torque = \"tau\", reference = \"q_ref\"}\n\n";
  if (smoothing.is_there) {
    (out << "[filter]\ncutoff_hz = ").number(smoothing.cutoff_hz) << "\nparallel_cutoff_hz = ";
    out.number(smoothing.parallel_cutoff_hz) << "\ndecimate_to_hz = ";
    out.number(smoothing.decimate_to_hz) << "\n\n";
  }
  out << "[model]\njoint = \"revolute\"\nterms = [\"inertia\", \"viscous\", \"coulomb\", \"offset\""
      << (which.rig.joint.has_gravity ? ", \"gravity\"" : "") << "]\n\n[diagnose]\ntwins = 60\n";
  out.close();
}

class Json {  // one level of names and values
 public:
  explicit Json(Text& out) : out_(out) { out_ << "{"; }
  Json& operator()(std::string_view name, double value) {
    key(name).number(value);
    return *this;
  }
  Json& operator()(std::string_view name, std::string_view word) {
    key(name) << "\"" << word << "\"";
    return *this;
  }
  Text& key(std::string_view name) {
    out_ << (first_ ? "\"" : ", \"") << name << "\": ";
    first_ = false;
    return out_;
  }
  void close() { out_ << "}"; }

 private:
  Text& out_;
  bool first_ = true;
};

void write_effect(Case const& which, Text& out) {
  HiddenEffect const& effect = *which.effect;
  Json about{out};
  about("name", effect.name)("family", effect.family)("form", effect.form)("relative_size", which.effect_size);
  Json parameters{about.key("parameters")};
  parameters(effect.amplitude_name, effect.sign * effect.amplitude);
  for (auto const& [name, value] : effect.shapes) parameters(name, value);
  parameters.close();
  about.close();
}

// Effects of the catalogue that are in the joint although the board does not count them as hidden: to name them is true
void write_besides(Case const& which, Text& out) {
  out << "[";
  bool const has_lag = which.rig.reading.commanded, bends = which.rig.sticking.has_bristles();
  if (has_lag) out << R"("actuator_lag", "delay")";
  if (bends) out << (has_lag ? ", " : "") << R"("presliding", "maxwell_slip")";
  out << "]";
}

void write_rig(Rig const& rig, Text& out) {
  Joint const& joint = rig.joint;
  StickingLaw const& sticking = rig.sticking;
  Json joint_text{out << ",\n \"joint\": "};
  joint_text("inertia", joint.inertia)("viscous", joint.viscous)("coulomb_positive", joint.dry_forward);
  joint_text("coulomb_negative", -joint.dry_backward)("offset", joint.offset);
  if (joint.has_gravity) joint_text("gravity_sin", joint.gravity_sin)("gravity_cos", joint.gravity_cos);
  joint_text.close();
  Json sticking_text{out << ",\n \"sticking\": "};
  sticking_text("law", to_text(sticking.law));
  if (sticking.law == Law::creep) sticking_text("speed_rad_s", sticking.speed);
  if (sticking.has_bristles()) sticking_text("length_rad", sticking.length)("damping", sticking.damping);
  if (sticking.law == Law::elastoplastic) sticking_text("elastic_share", sticking.elastic);
  sticking_text.close();
  Json control{out << ",\n \"control\": "};
  control("kind", rig.control.cascade ? "p_pi" : "pd")("rate_hz", rig.control.rate_hz);
  control("position_gain", rig.control.position_gain)("speed_gain", rig.control.speed_gain);
  control("integral_gain", rig.control.integral_gain)("speed_filter_hz", rig.control.speed_filter_hz);
  control.close();
  Json reading{out << ",\n \"reading\": "};
  reading("log_hz", rig.reading.log_hz)("encoder_bits", static_cast<double>(rig.reading.encoder_bits));
  reading("torque", rig.reading.commanded ? "commanded" : "given")("drive_lag_s", rig.reading.lag_s);
  reading("noise_share", rig.reading.noise_share);
  reading.close();
  Json motion{out << ",\n \"motion\": "};
  motion("kind", rig.limits.strokes ? "strokes" : "sines")("travel", rig.limits.travel)("speed", rig.limits.speed);
  motion("resting_share", rig.limits.strokes ? rig.limits.resting_share : 0.0);
  motion.close();
  (out << ",\n \"cutoff_hz\": ").number(rig.smoothing.cutoff_hz);  // 0: the job has no filter
}

void write_truth(Case const& which, std::filesystem::path const& path) {
  Text out{path};
  out << "{\"kind\": \"" << kind_of(which) << "\", \"suite_seed\": " << std::to_string(which.at.seed)
      << ", \"case\": " << std::to_string(which.at.number) << ", \"attempts\": " << std::to_string(which.at.attempt + 1)
      << ",\n \"effects\": [";
  if (which.effect) write_effect(which, out);
  write_besides(which, out << "],\n \"besides\": ");
  (out << ",\n \"torque_rms\": ").number(which.torque_rms);
  (out << ", \"sticking_size\": ").number(which.sticking_size);
  (out << ", \"lag_size\": ").number(which.lag_size);
  (out << ", \"tracking_error\": ").number(which.train.tracking_error);
  write_rig(which.rig, out);
  out << "}\n";
  out.close();
}

}  // namespace

void write_case(Case const& which, std::filesystem::path const& folder) {
  std::filesystem::create_directories(folder);
  write_recording(which, false, folder / "train.csv");
  write_recording(which, true, folder / "validate.csv");
  write_job(which, folder / "job.toml");
  write_truth(which, folder / "truth.json");
}

}  // namespace sticking
