// The commands. Each returns its exit code and throws phlux::Error on failure.
#pragma once

#include "cli/options.h"
#include "render/render.h"

namespace phlux::cli {

/// 0, or 130 when SIGINT or SIGTERM ended it; the image so far is then written.
[[nodiscard]] int render(const RenderOptions& options);

/// The settings that options other than those of settings::all() give.
[[nodiscard]] render::Settings defaults_of(const RenderOptions& options);

/// Makes the camera's image the part that the choices or else the scene name. @throws UsageError if it is no
/// part
void crop(scene::Scene& scene, const settings::Choices& choices);

/// 0.
[[nodiscard]] int info(const InfoOptions& options);

/// 0.
[[nodiscard]] int list_devices(const DevicesOptions& options);

/// 0, or 1 when a metric is above its limit. That of values that are not finite, whose pixels cannot be
/// compared, is 0 unless an option gives another.
[[nodiscard]] int compare(const CompareOptions& options);

/// 0.
[[nodiscard]] int merge(const MergeOptions& options);

/// 0. @throws WriteError if no tev listens and no picture is wanted
[[nodiscard]] int view(const ViewOptions& options);

/// 0, or 1 when a check failed; its histograms are then written to the working directory.
[[nodiscard]] int verify(const VerifyOptions& options);

} // namespace phlux::cli
