#include "engine/python/job_source.hpp"

#include "engine/experiment/foreign_file.hpp"

namespace torquescope {

Job read_source(JobSource const& source) {
  return source.text ? parse_job(*source.text, source.path) : read_job_file(source.path);
}

}  // namespace torquescope
