// The grammar of `phlux verify`.
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.h"
#include "cli/grammar.h"
#include "errors.h"
#include "render/render.h"
#include "settings/values.h"

namespace phlux::cli {
namespace {

void add_amount(CLI::App& app, VerifyOptions& options) {
  add_values(app, "--strategy", "NAME",
             fmt::format("may be repeated: {}; default: all", fmt::join(render::strategy_names(), ", ")),
             [&options](const std::string& text) {
               const auto& names = render::strategy_names();
               options.strategies.push_back(names[settings::choice("--strategy", text, names)]);
             });
  app.add_flag("--quick", options.quick, "fewer materials, angles and samples: about a third of the time");
  add_value(app, "--samples", "N", "of each material and angle; default: 16384, quick 8192",
            [&options](const std::string& text) {
              constexpr std::uint64_t least = 16, most = 1u << 24;
              options.samples = settings::whole_number("--samples", text, least, most);
            });
}

} // namespace

void add_verify(CLI::App& program, std::optional<Command>& command) {
  CLI::App& app =
      *program.add_subcommand("verify", "Proves that the reflectance model's functions agree on a device");
  const auto options = std::make_shared<VerifyOptions>();
  add_one_device(app, options->devices, options->lanes, options->kernel_dir);
  add_amount(app, *options);
  add_value(app, "--json", "FILE", "every figure, as JSON", [options](const std::string& text) {
    if (text.empty()) throw UsageError("--json '': must be a file name");
    options->json = text;
  });
  app.footer(
      "Exit code: 0, or 1 when a check failed; what was expected and what was seen is then in verify-*.csv "
      "and .png.");
  app.final_callback([&command, options] { command = [options] { return verify(*options); }; });
}

} // namespace phlux::cli
