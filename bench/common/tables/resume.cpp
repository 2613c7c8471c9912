#include "bench/common/tables/resume.h"

#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "bench/common/tables/csv.h"
#include "files/output.h"

namespace phlux::bench {

bool can_resume(const std::filesystem::path& folder, const std::string& name,
                const std::vector<std::string>& tables, const nlohmann::json& settings, bool fresh) {
  make_folder(folder);
  const std::filesystem::path path = folder / (name + ".settings.json");
  const std::string text = settings.dump(1) + "\n";
  std::ifstream file(path, std::ios::binary);
  if (!fresh && std::string(std::istreambuf_iterator<char>(file), {}) == text) return true;
  for (const std::string& table : tables) {
    std::error_code ignored; // reported later: a table that cannot be removed cannot be written
    std::filesystem::remove(folder / table, ignored);
  }
  files::write_file(path, text);
  return false;
}

} // namespace phlux::bench
