#include <cmath>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "errors.h"
#include "files/exr.h"
#include "files/output.h"
#include "files/png.h"
#include "files/tev.h"
#include "files/tone_map.h"
#include "terminal.h"

namespace phlux::cli {
namespace {

void write_picture(const ViewOptions& options, const files::Image& image) {
  const std::string name = options.picture.string();
  if (is_of_another_format(options.picture, ".png"))
    throw UsageError(fmt::format("--png {}: the picture is a PNG file", name));
  reject_inputs({options.picture}, {options.image});
  if (!image.has(files::radiance_names))
    throw FileError(
        fmt::format("{}: lacks a channel of R, G and B, which a picture shows", options.image.string()));
  const double exposure = options.exposure.value_or(std::log2(files::exposure(image)));
  files::write_png(options.picture, files::rows_of(image), exposure);
  say("{}: {}x{}, --exposure {:.3g}\n", name, image.width, image.height, exposure);
}

} // namespace

int view(const ViewOptions& options) {
  const files::Image image = files::read_exr(options.image);
  const std::string name = options.image.string();
  warn_if_changed(image, name);
  if (!options.picture.empty()) {
    write_picture(options, image);
    return 0;
  }
  if (!files::show_in_tev(image, name, options.tev))
    throw WriteError(fmt::format(
        "{}: no tev listens at {}: install and start it (github.com/Tom94/tev), or write a "
        "picture by --png {}",
        name, options.tev, std::filesystem::path(options.image).replace_extension(".png").string()));
  say("{}: in tev at {}\n", name, options.tev);
  return 0;
}

} // namespace phlux::cli
