#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "cli/spelling.h"
#include "errors.h"
#include "files/exr.h"
#include "files/merge.h"
#include "files/output.h"
#include "printable.h"
#include "terminal.h"

namespace phlux::cli {

int merge(const MergeOptions& options) {
  if (options.images.size() < 2)
    throw UsageError(
        fmt::format("merge {}: one image: at least two are needed", options.images.front().string()));
  reject_inputs({options.output}, options.images);
  require_exr(options.output);
  files::check_writable(options.output);
  files::Merger merger;
  for (const std::filesystem::path& file : options.images) merger.add(file.string(), files::read_exr(file));
  for (const std::string& note : merger.notes()) spdlog::warn("{}", with_options(note));
  const files::Image image = merger.result();
  warn_of_nonfinite(options.output, files::write_exr(options.output, image));
  say("{}: {}x{}, {:.6g} samples per pixel of {} images\n", printable(options.output.string()), image.width,
      image.height, image.info.samples, options.images.size());
  return 0;
}

} // namespace phlux::cli
