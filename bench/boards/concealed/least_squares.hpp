#pragma once
// Linear least squares by modified Gram-Schmidt, twice, on columns scaled to unit length.
//
// Shapes     columns: each as long as y
// Errors     std::invalid_argument: a column that depends on the others

#include <vector>

namespace concealed {

std::vector<double> least_squares(std::vector<std::vector<double>> columns, std::vector<double> y);

}  // namespace concealed
