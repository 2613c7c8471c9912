// The grammar of `phlux verify`.
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.h"
#include "cli/grammar.h"
#include "errors.h"
#include "lobes/models.h"
#include "render/render.h"
#include "settings/values.h"

namespace phlux::cli {
namespace {

void add_amount(CLI::App& app, VerifyOptions& options) {
  add_values(
      app, "--strategy", "NAME|FILE.cl",
      fmt::format(
          "sampling strategy of the phong model: {}, or a kernel file of your own; may be repeated; default: "
          "all of these, and all integrators",
          fmt::join(render::strategy_names(), ", ")),
      [&options](const std::string& text) {
        options.strategies.push_back(settings::strategy("--strategy", text));
      });
  add_values(app, "--integrator", "NAME",
             fmt::format("integrator: {}; may be repeated; default: all of these, and all strategies",
                         fmt::join(settings::integrator_names(), ", ")),
             [&options](const std::string& text) {
               options.integrators.push_back(settings::integrator_named(text).name);
             });
  add_flag(app, "--quick",
           "fewer materials, angles, samples and variants of integrators: about a third of the time",
           options.quick);
  add_value(app, "--samples", "N", "samples per material and angle; default: 16384, or 8192 with --quick",
            [&options](const std::string& text) {
              constexpr std::uint64_t least = 16, most = 1u << 24;
              options.samples = settings::whole_number("--samples", text, least, most);
            });
}

std::vector<std::string> model_names() {
  const lobes::Library library;
  std::vector<std::string> names;
  for (const auto& model : library.models()) names.push_back(model->name);
  return names;
}

void add_models(CLI::App& app, VerifyOptions& options) {
  add_lobes(app,
            "verifies a reflectance model of your own instead, by comparing its functions with each other; "
            "may be repeated",
            options.lobes);
  add_values(
      app, "--model", "NAME",
      fmt::format("the same for a built-in model: {}; may be repeated", fmt::join(model_names(), ", ")),
      [&options](const std::string& text) {
        const std::vector<std::string> names = model_names();
        options.models.push_back(names[settings::choice("--model", text, names)]);
      });
  add_values(app, "--set", "NAME=VALUE",
             "another value of a parameter of that model, such as exponent=90 or "
             "specularReflectance=0.9,0.6,0.2; its "
             "default and the ends of its range are always tested; may be repeated",
             [&options](const std::string& text) {
               options.parameters.push_back(settings::definition("--set", text));
             });
}

void require_model_to_set(const VerifyOptions& options) {
  if (options.parameters.empty() || !options.lobes.empty() || !options.models.empty()) return;
  const auto& [name, value] = options.parameters.front();
  throw UsageError(fmt::format("--set {}={}: needs --lobe FILE.cl or --model NAME", name, value));
}

void refuse_integrators_of_models(const VerifyOptions& options) {
  const bool of_model = !options.lobes.empty() || !options.models.empty() ||
                        std::ranges::any_of(options.strategies, settings::is_strategy_file);
  if (of_model && !options.integrators.empty())
    throw UsageError(fmt::format(
        "--integrator {}: cannot be used with --lobe, --model or --strategy FILE.cl, which verify a "
        "model without integrators: leave one of them out",
        options.integrators.front()));
}

} // namespace

void add_verify(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app = *program.add_subcommand("verify", "Checks reflectance models and integrators on a device");
  const auto options = std::make_shared<VerifyOptions>();
  add_one_device(app, options->devices, options->lanes, options->kernel_dir);
  add_models(app, *options);
  add_amount(app, *options);
  add_file(app, "--json", "FILE", "all results, as JSON", options->json);
  app.footer("Exit code: 0, or 1 if a check failed. Expected and observed values are then written to "
             "verify-*.csv and .png.");
  app.final_callback([&command, options] {
    require_model_to_set(*options);
    refuse_integrators_of_models(*options);
    command = [options] { return verify(*options); };
  });
}

} // namespace phlux::cli
