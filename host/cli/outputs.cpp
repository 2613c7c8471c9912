#include "cli/outputs.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <spdlog/stopwatch.h>

#include "cli/last_steps.h"
#include "errors.h"
#include "files/contributions.h"
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
  require_exr(image, ": --png names the preview");
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

// Whether a write replaces nothing, such as /dev/null.
bool is_device(const fs::path& file) {
  std::error_code error;
  return fs::is_character_file(file, error);
}

bool same(const fs::path& a, const fs::path& b) {
  return files::same_file(a, b) && !is_device(a);
}

} // namespace

void reject_same_names(const std::vector<fs::path>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i)
    for (std::size_t other = 0; other < i; ++other)
      if (same(outputs[i], outputs[other]))
        throw UsageError(
            fmt::format("{}: named for two outputs: each needs a file of its own", outputs[i].string()));
}

void warn_of_nonfinite(const fs::path& file, const files::NonFinite& values) {
  for (const auto& [channel, count] : values)
    spdlog::warn("{}: {} values of channel {} are not finite, being beyond a float's 3e38 or undefined: dim "
                 "the lights",
                 file.string(), count, channel);
}

void warn_if_changed(const files::Image& image, const std::string& name) {
  if (image.info.is_changed)
    spdlog::warn("{}: is damaged, or another program has changed it and copied its attributes", name);
}

bool is_of_another_format(const fs::path& file, const std::string& own) {
  const std::vector<std::string> formats = {".exr", ".png",  ".jpg", ".jpeg", ".hdr",  ".pfm", ".ppm",
                                            ".tif", ".tiff", ".bmp", ".gif",  ".webp", ".json"};
  const std::string extension = lower_case_extension(file);
  return extension != own && std::ranges::find(formats, extension) != formats.end();
}

void require_exr(const fs::path& image, const std::string& advice) {
  if (is_of_another_format(image, ".exr"))
    throw UsageError(fmt::format("--output {}: the image is an OpenEXR file, such as {}{}", image.string(),
                                 fs::path(image).replace_extension(".exr").string(), advice));
}

std::vector<fs::path> Outputs::files() const {
  std::vector<fs::path> files = {image, preview, statistics, checkpoint};
  std::erase(files, fs::path());
  return files;
}

Outputs outputs_of(const RenderOptions& options) {
  Outputs outputs{options.output,        options.preview,
                  options.statistics,    options.checkpoint.empty() ? options.resume : options.checkpoint,
                  options.contributions, options.aov};
  if (outputs.checkpoint == "none") outputs.checkpoint.clear();
  if (outputs.image.empty()) outputs.image = options.scene_file.stem() += ".exr";
  reject_other_formats(outputs.image, outputs.preview);
  if (outputs.preview == "none")
    outputs.preview.clear();
  else if (outputs.preview.empty())
    outputs.preview = preview_beside(outputs.image);
  reject_same_names(outputs.files());
  return outputs;
}

void reject_inputs(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
  for (const fs::path& output : outputs)
    for (const fs::path& input : inputs)
      if (same(output, input))
        throw UsageError(
            fmt::format("{}: named for an output, but {}: name another file", output.string(),
                        input == output ? "it is an input" : fmt::format("is the input {}", input.string())));
}

void reject_inputs(const Outputs& outputs, const RenderOptions& options, const scene::Scene& scene) {
  std::vector<fs::path> inputs = scene.files;
  inputs.insert(inputs.end(), options.lobes.begin(), options.lobes.end());
  if (const auto strategy = options.texts.find("strategy");
      strategy != options.texts.end() && settings::is_strategy_file(strategy->second))
    inputs.emplace_back(strategy->second);
  std::vector<fs::path> files = outputs.files();
  reject_inputs(files, inputs);
  if (!options.resume.empty()) { // which its own checkpoints may replace
    std::erase(files, outputs.checkpoint);
    reject_inputs(files, {options.resume});
  }
  if (outputs.contributions.empty()) return;
  inputs.push_back(options.resume);
  for (const std::vector<fs::path>& others : {inputs, outputs.files()})
    for (const fs::path& other : others)
      if (files::is_contribution(outputs.contributions, other))
        throw UsageError(fmt::format("--contributions {}: would replace {}: name another folder",
                                     outputs.contributions.string(), other.string()));
}

void check_writable(const Outputs& outputs) {
  for (const fs::path& file : outputs.files()) files::check_writable(file);
  if (!outputs.contributions.empty()) files::check_contributions_writable(outputs.contributions);
}

void PreviewRefresher::update(const film::Film& film, double seconds,
                              const std::function<bool()>& interrupted) {
  if (file_.empty() || seconds < next_) return;
  const spdlog::stopwatch watch;
  try {
    const auto check = [&](double) {
      if (interrupted()) throw StepInterrupted();
    };
    files::write_png(file_, files::with_progress(files::rows_of(film, false), check), exposure_);
  } catch (const StepInterrupted&) { // and the render ends
  } catch (const std::exception& error) {
    spdlog::info("{}", error.what());
  }
  next_ = seconds + std::max(seconds_between, watch.elapsed().count() / preview_share_of_time);
}

} // namespace phlux::cli
