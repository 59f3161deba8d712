#pragma once
// The names of columns that pandas.DataFrame.to_hdf keeps beside the numbers of a frame.
//
// fixed      blockK_items beside blockK_values; axis1 is the index
// table      rows of a compound type; the attribute FIELD_kind of a field holds the names of its numbers, as a pickle.
//            No pickle is run: a list of texts and whole numbers is read, anything else has no names
// Source     pandas/io/pytables.py; Lib/pickletools.py of CPython (protocol 0: opcodes l, a, p, V, I and STOP)
// Threads    one at a time, as HDF5

#include <hdf5.h>

#include <string>
#include <string_view>
#include <vector>

namespace torquescope {

bool is_fixed_frame(hid_t group);
// a dataset of names in a fixed frame
bool holds_pandas_names(std::string const& dataset);
// of a dataset in a fixed frame, each behind the prefix; none: it is no block and no index
std::vector<std::string> fixed_frame_names(hid_t group, std::string const& dataset, std::string const& prefix);
// of a field of a table; none: the attribute is missing, or no such list
std::vector<std::string> table_field_names(hid_t dataset, std::string const& field);

// "(lp0\nVq_rad\np1\na." -> "q_rad"; none: not a list of texts and whole numbers
std::vector<std::string> names_in_pickle(std::string_view pickle);

}  // namespace torquescope
