#include "cli/bench_model.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/grammar.h"
#include "errors.h"
#include "lobes/assignment.h"
#include "settings/values.h"

namespace phlux::cli {
namespace {

// Users' models. @throws UsageError for one with the name of a strategy, whose row would have the same name
std::vector<lobes::ModelPointer> own_models(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files)
    if (std::ranges::count(render::strategy_names(), file.stem().string()) > 0)
      throw UsageError(
          fmt::format("--lobe {}: a sampling strategy is called {} too: give the file another name",
                      file.string(), file.stem().string()));
  const lobes::Library library(files);
  std::vector<lobes::ModelPointer> models;
  for (const std::filesystem::path& file : files) models.push_back(library.find(file.stem().string()));
  return models;
}

// Built-in models besides phong whose f_r is all that they reflect.
std::vector<std::string> measurable_models() {
  const lobes::Library library;
  std::vector<std::string> names;
  for (const lobes::ModelPointer& model : library.models())
    if (!model->has_delta && !model->transmits && model->name != "phong") names.push_back(model->name);
  return names;
}

// A model with these values of its parameters, NAME=VALUE.
std::shared_ptr<const scene::Material> material_with(const lobes::ModelPointer& model,
                                                     const std::vector<std::string>& values) {
  scene::Material material = lobes::default_material(model);
  for (const std::string& value : values) {
    const std::size_t equals = value.find('=');
    if (equals == std::string::npos) throw UsageError(fmt::format("--set {}: must be NAME=VALUE", value));
    lobes::assign(material, value.substr(0, equals), value.substr(equals + 1));
  }
  return std::make_shared<const scene::Material>(std::move(material));
}

} // namespace

void add_bench_model(CLI::App& app, const std::shared_ptr<bench::SamplingOptions>& options) {
  const auto files = std::make_shared<std::vector<std::filesystem::path>>();
  const auto built_in = std::make_shared<std::string>();
  const auto values = std::make_shared<std::vector<std::string>>();
  add_values(
      app, "--lobe", "NAME.cl",
      "measures a reflectance model of your own instead, and for comparison sampling by the cosine and "
      "uniformly: "
      "sampling-NAME.csv, sampling-NAME-no-roulette.csv; may be repeated",
      [files](const std::string& text) { files->emplace_back(text); });
  add_value(app, "--model", "NAME",
            fmt::format("the same for a built-in model: {}", fmt::join(measurable_models(), ", ")),
            [built_in](const std::string& text) {
              const std::vector<std::string> names = measurable_models();
              *built_in = names[settings::choice("--model", text, names)];
            });
  add_values(app, "--set", "NAME=VALUE",
             "a parameter of that model; a colour takes one number or three, R,G,B; may be repeated",
             [values](const std::string& text) { values->push_back(text); });
  app.parse_complete_callback([=] {
    const bool own = !files->empty();
    if (!own && built_in->empty() && !values->empty())
      throw UsageError("--set: needs --lobe NAME.cl or --model NAME");
    if (!own && built_in->empty()) return;
    if (!options->strategies.empty() || !options->cases.empty() || !options->lights.empty() ||
        (own && !built_in->empty()))
      throw UsageError(own ? "--lobe: excludes --strategy, --case, --integrand and --model"
                           : "--model: excludes --strategy, --case and --integrand");
    if (files->size() > 1 && !values->empty())
      throw UsageError(
          fmt::format("--set {}: {} models are given: measure those with other parameters one by one",
                      values->front(), files->size()));
    const auto models = own ? own_models(*files) : std::vector{lobes::shipped(*built_in)};
    for (const lobes::ModelPointer& model : models)
      options->materials.push_back(material_with(model, *values));
  });
}

} // namespace phlux::cli
