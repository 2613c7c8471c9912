// The tables of bench/saved, and figures in the pages that come from them.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace phlux::test {

struct SavedTable {
  std::vector<std::vector<std::string>> rows;
  std::map<std::string, std::size_t> columns;

  [[nodiscard]] const std::string& at(std::size_t row, const std::string& column) const {
    return rows[row].at(columns.at(column));
  }
  [[nodiscard]] double number(std::size_t row, const std::string& column) const; ///< NaN if the cell is empty
  /// The name of the method in the pages, such as "path mis".
  [[nodiscard]] std::string method(std::size_t row) const;
};

/// A table of bench/saved.
[[nodiscard]] SavedTable saved(const std::string& name);

/// The cells of the row of a page of bench/ that begins with `first`; the first cell is empty.
[[nodiscard]] std::vector<std::string> row_of(const std::string& page, const std::string& first);
/// The first number in a cell; NaN if there is none.
[[nodiscard]] double number_in(const std::string& cell);
/// The number in place of the only # of a sentence of a page, whose lines may break anywhere.
[[nodiscard]] double stated(const std::string& page, const std::string& sentence);

[[nodiscard]] double geometric_mean(const std::vector<double>& values);

/// A number in a page, rounded to two digits or to a bound.
[[nodiscard]] inline Approx about(double value) {
  return Approx(value).epsilon(0.05);
}

/// The largest absolute value of a column in the rows that `chosen` selects.
template<typename Chosen>
double largest(const SavedTable& table, const std::string& column, const Chosen& chosen) {
  double most = 0.0;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (const double value = std::abs(table.number(row, column)); chosen(row) && value > most) most = value;
  return most;
}

} // namespace phlux::test
