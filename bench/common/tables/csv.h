// Tables of figures that grow line by line, so that what was measured before an interruption is kept.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace phlux::bench {

/// Creates `folder`, with those above it, where it is not there. @throws WriteError
void make_folder(const std::filesystem::path& folder);

class CsvFile {
public:
  /// Begins `folder`/`name` anew with this line of column names and the lines that are kept of it; they are
  /// there at every moment. @throws WriteError
  CsvFile(const std::filesystem::path& folder, const std::string& name, const std::string& header,
          const std::vector<std::string>& kept = {});

  /// Adds a line, whose values contain no commas. @throws WriteError
  void line(const std::string& text);
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::ofstream file_;
};

/// Fit to be a value of a table: without commas and line ends.
[[nodiscard]] std::string csv_value(std::string text);

} // namespace phlux::bench
