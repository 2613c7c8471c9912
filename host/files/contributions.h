// A folder with the contributions of each technique (film::Techniques).
#pragma once

#include <filesystem>

#include "files/exr.h"
#include "film/film.h"

namespace phlux::files {

/// Writes, for s light and t eye vertices, sS-tT.exr (weighted: they add up to the image) and
/// sS-tT-unweighted.exr (the technique's own estimate), and contributions.png, a contact sheet: a row for
/// every number of edges, columns s = 0, 1, ... of the weighted images on the left, of the unweighted on the
/// right. Creates the folder. Returns the numbers of values
/// that are not finite in all of them. @throws WriteError
NonFinite write_contributions(const std::filesystem::path& folder, film::Film& film, const RenderInfo& info);

/// Whether write_contributions() may replace `file`: its name is that of a contribution in `folder`.
[[nodiscard]] bool is_contribution(const std::filesystem::path& folder, const std::filesystem::path& file);

} // namespace phlux::files
