// A render with all that it takes to go on, in a file.
#pragma once

#include <filesystem>
#include <string>

#include "film/film.h"
#include "render/render.h"
#include "settings/choices.h"

namespace phlux::checkpoint {

/// A render but for its film.
struct Session {
  std::string scene;         ///< the file, as the user named it
  std::string scene_digest;  ///< scene::digest
  settings::Choices choices; ///< of the user
  render::Settings settings; ///< what they and the scene led to; in a file without where it runs
  render::RenderState state;
};

struct Checkpoint {
  Session session;
  film::Film film;
};

/// The bytes of a file: a line of text with the format's version, the digest of the rest (XXH3, 128 bits) and
/// its length, and the rest as cereal's portable binary archive.
[[nodiscard]] std::string encode(const Session& session, const film::Film& film);

/// @throws FileError when the file is missing, is no checkpoint, is of another version of the format, is cut
/// short or is damaged
[[nodiscard]] Checkpoint read(const std::filesystem::path& file);

} // namespace phlux::checkpoint
