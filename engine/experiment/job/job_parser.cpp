#include "engine/experiment/job/job_parser.hpp"

#include "engine/base/toml_sections.hpp"
#include "engine/experiment/job/not_a_job.hpp"

namespace torquescope {

std::vector<Section> parse_sections(std::string const& text, std::string const& file) {
  static TomlDialect const dialect{.noun = "job",
                                   .repeated = {"estimator", "recordings", "model.effects", "simulate.effects"},
                                   .map_keys = {"columns", "clocks", "encoding"},
                                   .section_example = "a section is written [filter], an estimator [[estimator]]",
                                   .where_to_read = "      (torquescope describe experiment)",
                                   .not_one = not_a_job};
  return toml_sections(text, file, dialect);
}

}  // namespace torquescope
