// A folder of what each way of making a path brings (film::Techniques).
#pragma once

#include <filesystem>

#include "files/image.h"
#include "film/film.h"

namespace phlux::files {

/// Writes, for s light and t eye vertices, sS-tT.exr (weighted: they add up to the image) and
/// sS-tT-unweighted.exr (what the technique brings by itself), and contributions.png, a contact sheet: a row
/// for every number of edges, from left to right s = 0, 1, ...; the weighted on the left, the unweighted on
/// the right. Makes the folder. @throws WriteError
void write_contributions(const std::filesystem::path& folder, film::Film& film, const RenderInfo& info);

} // namespace phlux::files
