// Files from which a render resumes.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "film/film.h"
#include "render/render.h"
#include "settings/choices.h"

namespace phlux::checkpoint {

/// The state of a render except its film.
struct Session {
  std::string scene;         ///< the file, as the user named it
  std::string scene_digest;  ///< digest_with_strategy()
  settings::Choices choices; ///< of the user
  render::Settings settings; ///< from the choices and the scene; a file omits those of execution
  render::RenderState state;
};

struct Checkpoint {
  Session session;
  film::Film film;
};

/// Writes a file: a line of text with the format's version, the digest (XXH3, 128 bits) and the length of the
/// rest; a line with the session's length; and two of cereal's portable binary archives, of the session and
/// of the film with its size. `to` must be able to seek. Takes no memory in proportion to the film.
/// `progress` must not throw.
void write(const Session& session, const film::Film& film, std::ostream& to,
           const film::Progress& progress = {});

/// The bytes that write() writes.
[[nodiscard]] std::string encode(const Session& session, const film::Film& film);

/// Memory and time are in proportion to the file's size: 4/3 of it for the film, and 40 MB. Whether the state
/// is one of the render at hand is up to check_same(). `storage` is the film's.
/// @throws FileError when the file is missing, no checkpoint, of another version of the format, truncated or
/// damaged
[[nodiscard]] Checkpoint read(const std::filesystem::path& file,
                              film::Storage storage = film::Storage::memory);

/// Whether a checkpoint may replace `file`: nothing is there, or an earlier checkpoint, of any format.
[[nodiscard]] bool is_replaceable(const std::filesystem::path& file);

} // namespace phlux::checkpoint
