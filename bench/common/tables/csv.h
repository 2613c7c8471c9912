// CSV tables that are written row by row, so that an interrupted measurement keeps its rows.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "files/output.h"

namespace phlux::bench {

using files::make_folder;

class CsvFile {
public:
  /// Replaces `folder`/`name` atomically by this header and these rows of its previous content.
  /// @throws WriteError
  CsvFile(const std::filesystem::path& folder, const std::string& name, const std::string& header,
          const std::vector<std::string>& kept = {});

  /// Appends a row; its values must not contain commas. @throws WriteError
  void line(const std::string& text);
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::ofstream file_;
};

/// The text with commas and line ends replaced by spaces.
[[nodiscard]] std::string csv_value(std::string text);

} // namespace phlux::bench
