#include "cli/bench_tables.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include <catch2/catch.hpp>

namespace {

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

} // namespace

std::vector<std::string> lines_of(const std::string& text) {
  return parts_of(text, '\n');
}

std::vector<std::string> split(const std::string& line) {
  return parts_of(line, ',');
}

long columns_of(const std::string& line) {
  return std::count(line.begin(), line.end(), ',') + 1;
}

std::string value_of(const std::string& row, const std::vector<std::string>& columns,
                     const std::string& name) {
  std::istringstream stream(row);
  std::string value;
  for (const std::string& column : columns) {
    std::getline(stream, value, ',');
    if (column == name) return value;
  }
  throw std::runtime_error("no column " + name);
}

bool has_charts(const Outcome& outcome) {
  if (outcome.err.find("python3-matplotlib") == std::string::npos) {
    CHECK(outcome.exit_code == 0);
    return true;
  }
  WARN("no matplotlib: the charts are not tested");
  CHECK(outcome.exit_code == 5);
  return false;
}

std::map<std::string, std::string> without_matplotlib(const TemporaryFolder& folder) {
  std::filesystem::create_directories(folder / "python");
  folder.write("python/matplotlib.py", "raise ImportError('not installed')\n");
  return {{"PYTHONPATH", folder / "python"}};
}

std::string shipped(const std::string& name) {
  return PHLUX_SOURCE_DIR "/scenes/" + name + ".xml";
}
