#include "sources/kernel_files.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "errors.h"
#include "input_file.h"
#include "sources/embedded.h"

namespace phlux::sources {

KernelFiles::KernelFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

std::string KernelFiles::read(const std::string& name) const {
  if (folder_.empty()) {
    const auto files = embedded_files();
    const auto file =
        std::find_if(files.begin(), files.end(), [&](const EmbeddedFile& each) { return each.name == name; });
    if (file == files.end()) throw DeviceError(fmt::format("no kernel file {} in this program", name));
    return std::string(file->text);
  }
  const auto path = folder_ / name;
  const auto text = kernel_text_of(path);
  if (!text) throw DeviceError(fmt::format("{}: no such kernel file", path.string()));
  return *text;
}

} // namespace phlux::sources
