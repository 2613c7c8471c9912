// A CSV file that a second run goes on with: what it holds of the same settings is kept.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace phlux::bench {

class SavedTable {
public:
  /// Reads `folder`/`name`; what was written with other columns, or ends in the middle of a line, is
  /// forgotten. The file changes with the next write.
  SavedTable(const std::filesystem::path& folder, const std::string& name, std::vector<std::string> columns);

  using Row = std::vector<std::string>; ///< a value for each column, without commas
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] const std::string& value(const Row& row, const std::string& column) const;

  void remove_if(const std::function<bool(const Row&)>& unwanted);
  void add(Row row);
  /// Replaces the file, whole or not at all. @throws WriteError
  void write() const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

} // namespace phlux::bench
