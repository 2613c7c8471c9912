#include "checkpoint/checkpoint.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <string_view>
#include <vector>

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <fmt/format.h>
#include <xxhash.h>

#include "checkpoint/input_archive.h"
#include "errors.h"
#include "files/file_buffer.h"
#include "settings/values.h"

namespace phlux::settings {

template<class Archive>
void serialize(Archive& archive, Choices& choices) {
  auto& [definitions, size, texts, auto_reasons] = choices;
  archive(definitions, size, texts, auto_reasons);
}

// As texts, so that a new setting does not change the format.
template<class Archive>
void save(Archive& archive, const Settings& settings) {
  archive(texts_of(settings, [](Affects affects) { return affects != Affects::execution; }));
}
template<class Archive>
void load(Archive& archive, Settings& settings) {
  std::map<std::string, std::string> texts;
  archive(texts);
  for (const auto& [name, text] : texts) named(name).read(text, settings);
}

} // namespace phlux::settings

// With structured bindings, a new member that is not serialized is a compile error.
namespace phlux::render {

template<class Archive>
void serialize(Archive& archive, Launch& launch) {
  auto& [first_job, jobs, first_sample, block_samples] = launch;
  archive(first_job, jobs, first_sample, block_samples);
}

template<class Archive>
void serialize(Archive& archive, SchedulePosition& position) {
  auto& [sample, pixel, block_samples, missing] = position;
  archive(sample, pixel, block_samples, missing);
}

template<class Archive>
void serialize(Archive& archive, Origin& origin) {
  auto& [pixel, sample, samples] = origin;
  archive(pixel, sample, samples);
}

template<class Archive>
void serialize(Archive& archive, Counts& counts) {
  auto& [paths, rays, shadow_rays, nonfinite, first_nonfinite] = counts;
  archive(paths, rays, shadow_rays, nonfinite, first_nonfinite);
}

template<class Archive>
void serialize(Archive& archive, RenderState& state) {
  archive(static_cast<Counts&>(state), state.position, state.seconds_render);
}

} // namespace phlux::render

namespace phlux::checkpoint {

template<class Archive>
void serialize(Archive& archive, Session& session) {
  auto& [scene, scene_digest, choices, settings, state] = session;
  archive(scene, scene_digest, choices, settings, state);
}

namespace {

// Must be raised with every change of the format; tests/checkpoint knows the length of a small file.
constexpr int format_version = 5;
constexpr std::string_view magic = "phlux checkpoint ";
constexpr std::uint64_t longest_session = 1 << 20; // bytes; what a forged one may take is in proportion

// The digest and the number of bytes that pass.
class Digest {
public:
  Digest() { XXH3_128bits_reset(state_.get()); }
  void add(const char* bytes, std::size_t count) {
    XXH3_128bits_update(state_.get(), bytes, count);
    length_ += count;
  }
  // The first line of a file with these bytes after it. Its length is always the same.
  [[nodiscard]] std::string first_line() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
    return fmt::format("{}{} {:016x}{:016x} {:020}\n", magic, format_version, hash.high64, hash.low64,
                       length_);
  }
  [[nodiscard]] std::uint64_t length() const { return length_; }

private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_{XXH3_createState()};
  std::uint64_t length_ = 0;
};

// Adds what is written to a digest, and passes it on by pieces.
class DigestBuffer final : public files::OutputBuffer {
public:
  DigestBuffer(std::streambuf& to, Digest& digest, double bytes, const film::Progress& progress)
      : to_(to), digest_(digest), bytes_(bytes), progress_(progress) {}

protected:
  int sync() override {
    const auto count = pptr() - pbase();
    digest_.add(pbase(), static_cast<std::size_t>(count));
    const bool written = to_.sputn(pbase(), count) == count;
    if (progress_) progress_(std::min(1.0, static_cast<double>(digest_.length()) / bytes_));
    start();
    return written ? 0 : -1;
  }

private:
  std::streambuf& to_;
  Digest& digest_;
  double bytes_; // that will pass, about
  const film::Progress& progress_;
};

std::string session_bytes(const Session& session) {
  std::ostringstream stream(std::ios::binary);
  {
    cereal::PortableBinaryOutputArchive archive(stream);
    archive(session);
  }
  return std::move(stream).str();
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw FileError(fmt::format("{}: {}", file.string(), what));
}

constexpr const char* remedy = "resume from an earlier checkpoint";

// The file after its first line, which has been checked, and the number of its bytes.
std::uint64_t open_checked(const std::filesystem::path& file, std::ifstream& stream) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    fail(file, "is not a file: a checkpoint is needed");
  stream.open(file, std::ios::binary);
  if (!stream) fail(file, fmt::format("cannot be read: {}: a checkpoint is needed", std::strerror(errno)));
  std::string line(Digest().first_line().size(), '\0');
  stream.read(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(static_cast<std::size_t>(stream.gcount()));
  if (!line.starts_with(magic)) fail(file, "is not a checkpoint of phlux: a checkpoint is needed");
  const std::string version = line.substr(magic.size(), line.find(' ', magic.size()) - magic.size());
  if (version != std::to_string(format_version))
    fail(file, fmt::format("is a checkpoint of format {}, and this is phlux " PHLUX_VERSION
                           ", which reads format {}: use the phlux that wrote it",
                           version, format_version));
  Digest digest;
  std::vector<char> bytes(1 << 20);
  while (stream) {
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    digest.add(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (line != digest.first_line()) {
    const bool truncated =
        !line.ends_with('\n') || line.substr(line.rfind(' ')) != fmt::format(" {:020}\n", digest.length());
    fail(file, fmt::format("{}: {}", truncated ? "is incomplete" : "is damaged", remedy));
  }
  stream.clear();
  stream.seekg(static_cast<std::streamoff>(line.size()));
  return digest.length();
}

void read_session(std::istream& stream, std::uint64_t bytes, Session& session) {
  if (bytes > longest_session) throw cereal::Exception("a long session");
  InputArchive archive(stream, bytes);
  archive(session);
  if (session.scene.size() > PATH_MAX) throw cereal::Exception("a long name");
  if (session.choices.size) {
    const auto [width, height] = *session.choices.size;
    if (width < 1 || height < 1 || width > settings::most_pixels / height) throw cereal::Exception("a size");
  }
}

film::Film read_film(std::istream& stream, std::uint64_t bytes, film::Storage storage) {
  InputArchive archive(stream, bytes);
  std::int32_t width = 0, height = 0;
  archive(width, height);
  if (width < 1 || height < 1 || static_cast<std::uint64_t>(width) > bytes / sizeof(film::Pixel) / height)
    throw cereal::Exception("a film that is larger than the file");
  film::Film film(width, height, storage);
  archive(film);
  return film;
}

} // namespace

bool is_replaceable(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error) || std::filesystem::is_empty(file, error)) return true;
  std::ifstream stream(file, std::ios::binary);
  std::string start(magic.size(), '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == magic;
}

void write(const Session& session, const film::Film& film, std::ostream& to, const film::Progress& progress) {
  const auto begin = to.tellp();
  to << Digest().first_line();
  Digest digest;
  {
    DigestBuffer buffer(*to.rdbuf(), digest, film.bytes(), progress);
    std::ostream rest(&buffer);
    const std::string first = session_bytes(session);
    rest << fmt::format("{:020}\n", first.size()) << first;
    try {
      cereal::PortableBinaryOutputArchive archive(rest);
      archive(std::int32_t{film.width()}, std::int32_t{film.height()}, film);
    } catch (const cereal::Exception&) { // which hides the stream's own error
      rest.setstate(std::ios::badbit);
    }
    if (!rest.flush()) to.setstate(std::ios::badbit);
  }
  to.seekp(begin) << digest.first_line();
  to.seekp(0, std::ios::end);
}

std::string encode(const Session& session, const film::Film& film) {
  std::ostringstream stream(std::ios::binary);
  write(session, film, stream);
  return std::move(stream).str();
}

Checkpoint read(const std::filesystem::path& file, film::Storage storage) {
  std::ifstream stream;
  std::uint64_t left = open_checked(file, stream);
  try {
    std::string line(21, '\0'); // the session's length
    stream.read(line.data(), static_cast<std::streamsize>(line.size()));
    std::uint64_t session_length = 0;
    std::from_chars(line.data(), line.data() + line.size(), session_length);
    Session session;
    read_session(stream, std::min(session_length, left), session);
    stream.seekg(static_cast<std::streamoff>(Digest().first_line().size() + line.size() + session_length));
    left -= std::min(left, line.size() + session_length);
    return {std::move(session), read_film(stream, left, storage)};
  } catch (const UsageError& error) {
    fail(file, fmt::format("is not of this version of phlux: {}: use the phlux that wrote it", error.what()));
  } catch (const cereal::Exception&) { // the digest matches, but phlux did not write the file
    fail(file, fmt::format("is damaged: {}", remedy));
  }
}

} // namespace phlux::checkpoint
