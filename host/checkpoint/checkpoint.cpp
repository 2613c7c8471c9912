#include "checkpoint/checkpoint.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <fmt/format.h>
#include <xxhash.h>

#include "errors.h"

namespace phlux::settings {

template<class Archive>
void serialize(Archive& archive, Choices& choices) {
  auto& [definitions, size, texts] = choices;
  archive(definitions, size, texts);
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
constexpr int format_version = 4;
constexpr std::string_view magic = "phlux checkpoint ";

std::string digest_of(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

// Its length does not depend on `rest`.
std::string first_line(std::string_view rest) {
  return fmt::format("{}{} {} {:020}\n", magic, format_version, digest_of(rest), rest.size());
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw FileError(fmt::format("{}: {}", file.string(), what));
}

constexpr const char* remedy = "go on from an earlier checkpoint";

std::string text_of(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    fail(file, "is no file: a checkpoint is needed");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, fmt::format("cannot be read: {}: a checkpoint is needed", std::strerror(errno)));
  std::string line(first_line("").size(), '\0');
  stream.read(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(static_cast<std::size_t>(stream.gcount()));
  if (!line.starts_with(magic)) fail(file, "is no checkpoint of phlux: a checkpoint is needed");
  const std::string version = line.substr(magic.size(), line.find(' ', magic.size()) - magic.size());
  if (version != std::to_string(format_version))
    fail(file, fmt::format("is a checkpoint of format {}, and this is phlux " PHLUX_VERSION
                           ", which reads format {}: go on with the phlux that wrote it",
                           version, format_version));
  std::string rest(std::istreambuf_iterator<char>(stream), {});
  if (line == first_line(rest)) return rest;
  const bool truncated =
      !line.ends_with('\n') || line.substr(line.rfind(' ')) != fmt::format(" {:020}\n", rest.size());
  fail(file, fmt::format("{}: {}", truncated ? "is not whole" : "is damaged", remedy));
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

std::string encode(const Session& session, const film::Film& film) {
  const std::string place_holder = first_line("");
  std::ostringstream stream(place_holder, std::ios::binary | std::ios::ate);
  {
    cereal::PortableBinaryOutputArchive archive(stream);
    archive(session, film);
  }
  std::string bytes = std::move(stream).str();
  const std::string_view rest = std::string_view(bytes).substr(place_holder.size());
  bytes.replace(0, place_holder.size(), first_line(rest));
  return bytes;
}

Checkpoint read(const std::filesystem::path& file) {
  std::istringstream stream(text_of(file), std::ios::binary);
  Checkpoint result{{}, film::Film(1, 1)};
  try {
    cereal::PortableBinaryInputArchive archive(stream);
    archive(result.session, result.film);
  } catch (const UsageError& error) {
    fail(file, fmt::format("is not of this version of phlux: {}: go on with the phlux that wrote it",
                           error.what()));
  } catch (const cereal::Exception&) { // the digest matches, but phlux did not write the file
    fail(file, fmt::format("is damaged: {}", remedy));
  }
  return result;
}

} // namespace phlux::checkpoint
