// A CSV file that a later run reads and continues.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace phlux::bench {

class SavedTable {
public:
  /// Reads `folder`/`name` if it exists and has these columns; drops an incomplete last line. The file is not
  /// changed before write().
  SavedTable(const std::filesystem::path& folder, const std::string& name, std::vector<std::string> columns);

  using Row = std::vector<std::string>; ///< one value per column, without commas
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] const std::string& value(const Row& row, const std::string& column) const;

  void remove_if(const std::function<bool(const Row&)>& unwanted);
  void add(Row row);
  /// Replaces the file atomically. @throws WriteError
  void write() const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

} // namespace phlux::bench
