#pragma once
// Which dataset holds the values along each dimension of another: HDF5 dimension scales, from which xarray, netCDF and
// h5py know axes and their names.
//
// Scale      a list whose only dimension has its own name: "time" over {"time"}
// Others     each dimension names a scale of its length, in the dataset's group or in one around it
// Bytes      attributes CLASS, NAME, REFERENCE_LIST and DIMENSION_LIST, as the HDF5 Dimension Scale Specification has
//            them (The HDF Group, 2005). They hold addresses, so the content digest leaves them out.
// Errors     h5::Failure; a dimension that no scale fits is the caller's mistake (contract)
// Threads    one at a time

#include <map>
#include <string>
#include <vector>

#include "engine/store/h5.hpp"

namespace torquescope {

class DimensionScales {
 public:
  // of a dataset at `path`; nothing is kept of one without names or without values
  void add(std::string const& path, h5::Shape const& shape, std::vector<std::string> const& names);
  // once, when every dataset is there
  void attach(h5::Handle const& file) const;

 private:
  struct Dimensions {
    h5::Shape shape;
    std::vector<std::string> names;
  };

  std::string scale_of(std::string const& path, std::string const& name, std::size_t extent) const;

  std::map<std::string, Dimensions> datasets_;
};

}  // namespace torquescope
