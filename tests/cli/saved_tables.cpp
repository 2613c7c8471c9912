#include "cli/saved_tables.h"

#include <algorithm>
#include <cctype>

#include "cli/page_text.h"

namespace phlux::test {
namespace {

std::vector<std::string> cells_of_csv(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

} // namespace

double SavedTable::number(std::size_t row, const std::string& column) const {
  return at(row, column).empty() ? NAN : std::stod(at(row, column));
}

std::string SavedTable::method(std::size_t row) const {
  return trimmed(replaced(at(row, "integrator") + " " + at(row, "connect_or_weights"), " -", ""));
}

SavedTable saved(const std::string& name) {
  SavedTable table;
  for (const std::string& line : lines_of(source / "bench/saved" / name))
    table.rows.push_back(cells_of_csv(line));
  for (std::size_t i = 0; i < table.rows[0].size(); ++i) table.columns[table.rows[0][i]] = i;
  table.rows.erase(table.rows.begin());
  return table;
}

std::vector<std::string> row_of(const std::string& page, const std::string& first) {
  for (const std::string& line : lines_of(source / "bench" / page)) {
    if (!line.starts_with("| " + first + " |")) continue;
    std::vector<std::string> cells;
    for (const std::string& cell : split(line, "|")) cells.push_back(trimmed(cell));
    return cells;
  }
  FAIL(page << " has no row " << first);
  return {};
}

double number_in(const std::string& cell) {
  std::string digits;
  for (const char c : cell)
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.')
      digits += c;
    else if (c == ' ' && !digits.empty())
      break;
  return digits.empty() ? NAN : std::stod(digits);
}

double stated(const std::string& page, const std::string& sentence) {
  std::string text;
  for (const std::string& line : lines_of(source / page)) text += trimmed(line) + " ";
  const std::vector<std::string> parts = split(sentence, "#");
  for (std::size_t at = text.find(parts.at(0)); at != std::string::npos; at = text.find(parts[0], at + 1)) {
    const std::size_t begin = at + parts[0].size();
    std::size_t end = std::min(text.find_first_not_of("0123456789.,e-", begin), text.size());
    while (end > begin && std::isdigit(static_cast<unsigned char>(text[end - 1])) == 0) --end;
    if (text.substr(end).starts_with(parts.at(1)) && end > begin)
      return std::stod(replaced(text.substr(begin, end - begin), ",", ""));
  }
  FAIL(page << " has no sentence \"" << sentence << '"');
  return NAN;
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

} // namespace phlux::test
