// A folder with the contributions of each technique (film::Techniques).
#pragma once

#include <filesystem>

#include "files/canvas.h"
#include "files/exr.h"
#include "film/film.h"

namespace phlux::files {

/// The contributions of each technique, with (s,t) above each image for s light and t eye vertices: a row for
/// every number of edges, columns s = 0, 1, ... of the weighted images on the left, of the unweighted ones on
/// the right. All have one exposure; large images are reduced. The film records techniques.
[[nodiscard]] Canvas contact_sheet(film::Film& film);

/// Creates the folder, and checks before a long render that files can be written to it. @throws WriteError
void check_contributions_writable(const std::filesystem::path& folder);

/// Writes sS-tT.exr (weighted: they add up to the image), sS-tT-unweighted.exr (the technique's own estimate)
/// and contributions.png, the contact_sheet(). Creates the folder; removes the files that an earlier call has
/// left there. Returns the numbers of values that are not finite in all images. @throws WriteError
NonFinite write_contributions(const std::filesystem::path& folder, film::Film& film, const RenderInfo& info,
                              const film::Progress& progress = {});

/// Whether write_contributions() may replace or remove `file`: its name is that of a contribution in
/// `folder`. Neither need exist.
[[nodiscard]] bool is_contribution(const std::filesystem::path& folder, const std::filesystem::path& file);

} // namespace phlux::files
