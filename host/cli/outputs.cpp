#include "cli/outputs.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <spdlog/stopwatch.h>

#include "errors.h"
#include "files/output.h"
#include "files/png.h"

namespace phlux::cli {
namespace fs = std::filesystem;
namespace {

constexpr double preview_share_of_time = 0.02;

std::string lower_case_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

void reject_other_formats(const fs::path& image, const fs::path& preview) {
  if (is_of_another_format(image, ".exr"))
    throw UsageError(
        fmt::format("--output {}: the image is an OpenEXR file, such as {}: --png names the preview",
                    image.string(), fs::path(image).replace_extension(".exr").string()));
  if (is_of_another_format(preview, ".png"))
    throw UsageError(fmt::format("--png {}: the preview is a PNG file, such as {}; none: without one",
                                 preview.string(), fs::path(preview).replace_extension(".png").string()));
}

fs::path preview_beside(const fs::path& image) {
  std::error_code error;
  if (fs::exists(image, error) && !fs::is_regular_file(image, error)) return {};
  if (lower_case_extension(image) == ".exr") return fs::path(image).replace_extension(".png");
  return fs::path(image) += ".png";
}

void reject_same_names(const Outputs& outputs) {
  std::vector<fs::path> names;
  for (const fs::path& file : {outputs.image, outputs.preview, outputs.statistics, outputs.checkpoint}) {
    const fs::path name = file.lexically_normal();
    if (!name.empty() && name != "/dev/null" && std::ranges::find(names, name) != names.end())
      throw UsageError(
          fmt::format("{}: named for two outputs: image, preview, statistics and checkpoint need a file each",
                      file.string()));
    names.push_back(name);
  }
}

} // namespace

void warn_of_nonfinite(const fs::path& file, const files::NonFinite& values) {
  for (const auto& [channel, count] : values)
    spdlog::warn("{}: {} values of channel {} are not finite, being beyond a float's 3e38 or undefined: dim "
                 "the lights",
                 file.string(), count, channel);
}

bool is_of_another_format(const fs::path& file, const std::string& own) {
  const std::vector<std::string> formats = {".exr", ".png",  ".jpg", ".jpeg", ".hdr",  ".pfm", ".ppm",
                                            ".tif", ".tiff", ".bmp", ".gif",  ".webp", ".json"};
  const std::string extension = lower_case_extension(file);
  return extension != own && std::ranges::find(formats, extension) != formats.end();
}

Outputs outputs_of(const RenderOptions& options) {
  Outputs outputs{options.output, options.preview, options.statistics,
                  options.checkpoint.empty() ? options.resume : options.checkpoint};
  if (outputs.checkpoint == "none") outputs.checkpoint.clear();
  if (outputs.image.empty()) outputs.image = options.scene_file.stem() += ".exr";
  reject_other_formats(outputs.image, outputs.preview);
  if (outputs.preview == "none")
    outputs.preview.clear();
  else if (outputs.preview.empty())
    outputs.preview = preview_beside(outputs.image);
  reject_same_names(outputs);
  return outputs;
}

void check_writable(const Outputs& outputs) {
  for (const fs::path& file : {outputs.image, outputs.preview, outputs.statistics, outputs.checkpoint})
    if (!file.empty()) files::check_writable(file);
}

void PreviewRefresher::update(const film::Film& film, double seconds) {
  if (file_.empty() || seconds < next_) return;
  const spdlog::stopwatch watch;
  try {
    files::write_png(file_, files::rows_of(film, false));
  } catch (const WriteError& error) {
    spdlog::info("{}", error.what());
  }
  next_ = seconds + std::max(seconds_between, watch.elapsed().count() / preview_share_of_time);
}

} // namespace phlux::cli
