#include "concealed/least_squares.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace concealed {
namespace {

double dot(std::vector<double> const& a, std::vector<double> const& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

std::vector<double> least_squares(std::vector<std::vector<double>> columns, std::vector<double> y) {
  std::size_t const n = columns.size();
  std::vector<double> scale(n);
  std::vector<std::vector<double>> upper(n, std::vector<double>(n, 0.0));
  for (std::size_t j = 0; j < n; ++j) {
    auto& column = columns[j];
    scale[j] = std::sqrt(dot(column, column));
    if (!(scale[j] > 0.0)) throw std::invalid_argument("least squares: a column is zero");
    for (double& value : column) value /= scale[j];
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t i = 0; i < j; ++i) {
        double const part = dot(columns[i], column);
        upper[i][j] += part;
        for (std::size_t k = 0; k < y.size(); ++k) column[k] -= part * columns[i][k];
      }
    }
    upper[j][j] = std::sqrt(dot(column, column));
    if (upper[j][j] < 1e-10) throw std::invalid_argument("least squares: a column depends on the others");
    for (double& value : column) value /= upper[j][j];
  }
  std::vector<double> answer(n);
  for (std::size_t j = 0; j < n; ++j) {
    answer[j] = dot(columns[j], y);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] -= answer[j] * columns[j][k];
  }
  for (std::size_t j = n; j-- > 0;) {
    for (std::size_t i = j + 1; i < n; ++i) answer[j] -= upper[j][i] * answer[i];
    answer[j] /= upper[j][j];
  }
  for (std::size_t j = 0; j < n; ++j) answer[j] /= scale[j];
  return answer;
}

}  // namespace concealed
