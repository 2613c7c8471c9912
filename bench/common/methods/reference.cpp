#include "bench/common/methods/reference.h"

#include <algorithm>
#include <fstream>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/common/tables/csv.h"
#include "errors.h"
#include "files/exr.h"
#include "files/json.h"
#include "files/output.h"

namespace phlux::bench {
namespace {

constexpr int repeats_of_reference = 8; // from which its own variance is estimated
constexpr std::uint64_t first_seed = 2'000'000;

const std::vector<std::string> radiance_channels = {"R", "G", "B"};
const std::vector<std::string> variance_channels = {"variance.R", "variance.G", "variance.B"};

std::filesystem::path json_file(std::filesystem::path file) {
  return file.replace_extension(".json");
}

std::vector<double> read_channels(const files::Image& image, const std::vector<std::string>& names) {
  std::vector<double> values;
  for (std::size_t pixel = 0; pixel < image.channels.at(names[0]).size(); ++pixel)
    for (const std::string& name : names)
      values.push_back(static_cast<double>(image.channels.at(name).at(pixel)));
  return values;
}

void add_channels(files::Image& image, const std::vector<std::string>& names,
                  const std::vector<double>& values) {
  for (std::size_t value = 0; value < values.size(); ++value)
    image.channels[names[value % 3]].push_back(static_cast<float>(values[value]));
}

} // namespace

ReferenceImage make_reference(MethodRenderer& renderer, const Method& method, const scene::Camera& camera,
                              std::uint64_t seed, double seconds, const std::function<bool()>& interrupted) {
  std::vector<ImageEstimate> repeats;
  ReferenceImage reference;
  for (std::uint64_t i = 0; i < repeats_of_reference; ++i) {
    const TimedRender render =
        renderer.render_for(seed + first_seed + i, seconds / repeats_of_reference, {}, interrupted);
    repeats.push_back(render.last.image);
    reference.seconds += render.last.seconds;
    reference.samples_per_pixel += render.samples_per_pixel();
  }
  reference.image = pooled_reference(repeats, static_cast<std::size_t>(camera.width));
  reference.mean = mean_of(image_means(repeats));
  reference.repeats = repeats_of_reference;
  reference.method = method.name();
  return reference;
}

std::optional<ReferenceImage> read_reference(const std::filesystem::path& file, const std::string& settings) {
  if (!std::filesystem::exists(file) || !std::filesystem::exists(json_file(file))) return std::nullopt;
  try {
    std::ifstream stream(json_file(file));
    const nlohmann::json json = nlohmann::json::parse(stream);
    if (json.at("settings") != settings) return std::nullopt;
    ReferenceImage reference;
    const files::Image image = files::read_exr(file);
    reference.image =
        noisy_reference(read_channels(image, radiance_channels), read_channels(image, variance_channels),
                        static_cast<std::size_t>(image.width));
    json.at("mean").get_to(reference.mean.value);
    json.at("mean_standard_error").get_to(reference.mean.standard_error);
    json.at("repeats").get_to(reference.repeats);
    reference.mean.degrees = std::max(reference.repeats - 1, 1);
    json.at("method").get_to(reference.method);
    json.at("seconds").get_to(reference.seconds);
    json.at("samples_per_pixel").get_to(reference.samples_per_pixel);
    return reference;
  } catch (const std::exception& error) { // from the EXR file, the JSON parser or a missing key
    throw FileError(fmt::format("{}: is a damaged reference ({}): delete it, and it will be rendered again",
                                file.string(), error.what()));
  }
}

void write_reference(const std::filesystem::path& file, const std::string& settings,
                     const ReferenceImage& reference, const scene::Camera& camera) {
  files::Image image;
  image.width = camera.width;
  image.height = camera.height;
  add_channels(image, radiance_channels, reference.image.radiance);
  add_channels(image, variance_channels, reference.image.variance);
  image.info.version = PHLUX_VERSION;
  image.info.scene = file.stem().string();
  image.info.settings["integrator"] = reference.method;
  image.info.samples = reference.samples_per_pixel;
  image.info.seconds = reference.seconds;
  files::write_exr(file, image);
  files::write_file(json_file(file), files::json_text({{"settings", settings},
                                                       {"method", reference.method},
                                                       {"seconds", reference.seconds},
                                                       {"samples_per_pixel", reference.samples_per_pixel},
                                                       {"relmse", reference.image.relmse()},
                                                       {"mean", reference.mean.value},
                                                       {"mean_standard_error", reference.mean.standard_error},
                                                       {"repeats", reference.repeats}}));
}

ReferenceImage saved_reference(const std::filesystem::path& file, const std::string& settings,
                               const scene::Camera& camera, const std::function<ReferenceImage()>& make) {
  if (auto saved = read_reference(file, settings)) return *saved;
  const ReferenceImage reference = make();
  make_folder(file.parent_path());
  write_reference(file, settings, reference, camera);
  return reference;
}

} // namespace phlux::bench
