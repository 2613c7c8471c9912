#include "bench/common/methods/reference.h"

#include <fstream>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/common/methods/timed_render.h"
#include "errors.h"
#include "files/exr.h"
#include "files/json.h"
#include "files/output.h"

namespace phlux::bench {
namespace {

constexpr int repeats_of_reference = 4; // from which its own error is estimated
constexpr std::uint64_t first_seed = 2'000'000;

constexpr std::array<const char*, 3> channel_names = {"R", "G", "B"};

std::filesystem::path json_file(std::filesystem::path file) {
  return file.replace_extension(".json");
}

Reference radiance_of(const files::Image& image) {
  Reference radiance;
  for (std::size_t pixel = 0; pixel < image.channels.at("R").size(); ++pixel)
    for (const char* name : channel_names)
      radiance.push_back(static_cast<double>(image.channels.at(name)[pixel]));
  return radiance;
}

} // namespace

ReferenceImage make_reference(const scene::Scene& scene, const Method& method, render::Settings settings,
                              double seconds, const std::function<bool()>& interrupted) {
  std::vector<ImageEstimate> repeats;
  ReferenceImage reference;
  const std::uint64_t seed = settings.seed + first_seed;
  for (int i = 0; i < repeats_of_reference; ++i) {
    settings.seed = seed + static_cast<std::uint64_t>(i);
    const TimedRender render = render_for(scene, settings, seconds / repeats_of_reference, {}, interrupted);
    repeats.push_back(render.last.image);
    reference.seconds += render.last.seconds;
    reference.samples_per_pixel += render.samples_per_pixel();
  }
  reference.radiance = pooled(repeats).radiance;
  reference.relmse = variance_per_sample(repeats, reference.radiance).value / reference.samples_per_pixel;
  reference.mean = image_mean(repeats);
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
    reference.radiance = radiance_of(files::read_exr(file));
    json.at("relmse").get_to(reference.relmse);
    json.at("mean").get_to(reference.mean.value);
    json.at("mean_standard_error").get_to(reference.mean.standard_error);
    json.at("repeats").get_to(reference.repeats);
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
  for (std::size_t value = 0; value < reference.radiance.size(); ++value)
    image.channels[channel_names[value % 3]].push_back(static_cast<float>(reference.radiance[value]));
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
                                                       {"relmse", reference.relmse},
                                                       {"mean", reference.mean.value},
                                                       {"mean_standard_error", reference.mean.standard_error},
                                                       {"repeats", reference.repeats}}));
}

} // namespace phlux::bench
