#include "bench/common/tables/csv.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::bench {

CsvFile::CsvFile(const std::filesystem::path& folder, const std::string& name, const std::string& header,
                 const std::vector<std::string>& kept)
    : path_(folder / name) {
  make_folder(folder);
  std::filesystem::path beginning = path_;
  beginning += ".tmp";
  file_.open(beginning);
  line(header);
  for (const std::string& one : kept) line(one);
  std::error_code error;
  std::filesystem::rename(beginning, path_, error); // file_ stays open and continues to write to it
  if (error)
    throw WriteError(
        fmt::format("{}: cannot be written: {}: choose another folder", path_.string(), error.message()));
}

void CsvFile::line(const std::string& text) {
  file_ << text << '\n' << std::flush;
  if (!file_)
    throw WriteError(path_.string() + ": cannot be written: free disk space or choose another folder");
}

std::string csv_value(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == ',' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

} // namespace phlux::bench
