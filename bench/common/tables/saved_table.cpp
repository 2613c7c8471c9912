#include "bench/common/tables/saved_table.h"

#include <algorithm>
#include <cassert>
#include <fstream>
#include <sstream>

#include <fmt/ranges.h>

#include "files/output.h"

namespace phlux::bench {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> values;
  std::istringstream stream(line);
  for (std::string value; std::getline(stream, value, ',');) values.push_back(value);
  if (line.empty() || line.ends_with(',')) values.emplace_back();
  return values;
}

} // namespace

SavedTable::SavedTable(const std::filesystem::path& folder, const std::string& name,
                       std::vector<std::string> columns)
    : path_(folder / name), columns_(std::move(columns)) {
  std::ifstream file(path_);
  std::string line;
  if (!std::getline(file, line) || split(line) != columns_) return;
  while (std::getline(file, line) && !file.eof())
    if (Row row = split(line); row.size() == columns_.size()) rows_.push_back(std::move(row));
}

const std::string& SavedTable::value(const Row& row, const std::string& column) const {
  const auto found = std::ranges::find(columns_, column);
  assert(found != columns_.end());
  return row[static_cast<std::size_t>(found - columns_.begin())];
}

void SavedTable::remove_if(const std::function<bool(const Row&)>& unwanted) {
  std::erase_if(rows_, unwanted);
}

void SavedTable::add(Row row) {
  assert(row.size() == columns_.size());
  rows_.push_back(std::move(row));
}

void SavedTable::write() const {
  std::string text = fmt::format("{}\n", fmt::join(columns_, ","));
  for (const Row& row : rows_) text += fmt::format("{}\n", fmt::join(row, ","));
  files::write_file(path_, text);
}

} // namespace phlux::bench
