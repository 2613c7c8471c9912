// The files that a render writes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/options.h"
#include "files/exr.h"
#include "scene/scene.h"

namespace phlux::cli {

/// An empty name: not written.
struct Outputs {
  std::filesystem::path image, preview, statistics, checkpoint;
  std::filesystem::path contributions; ///< folder
  std::vector<std::string> aov;        ///< further channels of the image

  [[nodiscard]] std::vector<std::filesystem::path> files() const; ///< those that have a name
};

/// Warns of values that are NaN or infinite.
void warn_of_nonfinite(const std::filesystem::path& file, const files::NonFinite& values);

/// Warns of an image that is not as phlux wrote it (files::RenderInfo).
void warn_if_changed(const files::Image& image, const std::string& name);

/// Whether the file's name says that it is an image of another format than `own`, such as ".png".
[[nodiscard]] bool is_of_another_format(const std::filesystem::path& file, const std::string& own);
/// @throws UsageError, which ends with `advice`, if --output has the name of another format than OpenEXR
void require_exr(const std::filesystem::path& image, const std::string& advice = "");

/// The options' files or their defaults; the default checkpoint is the file that the render resumes from.
/// There is no default preview for an image that is not a regular file (/dev/null).
/// @throws UsageError for two outputs in one file, or the name of another image format
[[nodiscard]] Outputs outputs_of(const RenderOptions& options);

/// @throws UsageError if two of `outputs` are one file
void reject_same_names(const std::vector<std::filesystem::path>& outputs);

/// @throws UsageError if a file of `outputs` is one of `inputs`, the files that are read
void reject_inputs(const std::vector<std::filesystem::path>& outputs,
                   const std::vector<std::filesystem::path>& inputs);

/// The same for a render of `scene`, and for the files of its --contributions.
void reject_inputs(const Outputs& outputs, const RenderOptions& options, const scene::Scene& scene);

/// @throws WriteError for the first file that cannot be written
void check_writable(const Outputs& outputs);

/// Rewrites the preview during the render, at most every three seconds and for at most 2% of the time. A
/// failure is only noted.
class PreviewRefresher {
public:
  /// `exposure` as RenderOptions'.
  PreviewRefresher(std::filesystem::path file, std::optional<double> exposure)
      : file_(std::move(file)), exposure_(exposure) {}
  /// `seconds` of rendering so far. A preview that is being written when `interrupted` is left out.
  void update(const film::Film& film, double seconds, const std::function<bool()>& interrupted);

private:
  std::filesystem::path file_;
  std::optional<double> exposure_;
  double next_ = seconds_between;
  static constexpr double seconds_between = 3.0;
};

} // namespace phlux::cli
