// Declares options that several commands share.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/command_line.h"
#include "render/render.h"
#include "settings/choices.h"

namespace phlux::cli {

// The help's second column starts at first_column and ends at last_column.
inline constexpr std::size_t first_column = 30, last_column = 100;

[[nodiscard]] std::string wrapped(const std::string& text);

constexpr char between_values = '\x1f'; // of an option that is repeated

// The value of a repeated option. @throws UsageError if they are not all the same
[[nodiscard]] std::string only_value(const std::string& names, const std::string& joined);

// An option with one value, which is passed to `set` as text; it may be repeated with the same value alone.
template<class Set>
CLI::Option* add_value(CLI::App& app, const std::string& names, const std::string& value,
                       const std::string& help, Set set) {
  return app
      .add_option_function<std::string>(
          names, [set, names](const std::string& joined) { set(only_value(names, joined)); }, wrapped(help))
      ->type_name(value)
      ->join(between_values);
}

// An option that may be repeated, one value each time.
template<class Add>
CLI::Option* add_values(CLI::App& app, const std::string& names, const std::string& value,
                        const std::string& help, Add add) {
  return app
      .add_option_function<std::vector<std::string>>(
          names,
          [add](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) add(text);
          },
          wrapped(help))
      ->type_name(value)
      ->allow_extra_args(false);
}

// An option with the name of a file. `names`: "-o,--output". @throws UsageError while parsing an empty name
void add_file(CLI::App& app, const std::string& names, const std::string& value, const std::string& help,
              std::filesystem::path& file);

// An option without a value.
inline void add_flag(CLI::App& app, const std::string& names, const std::string& help, bool& flag) {
  app.add_flag(names, flag, wrapped(help));
}

// --exposure of a PNG picture.
void add_exposure(CLI::App& app, std::optional<double>& stops);

// The option of a setting.
void add_setting(CLI::App& app, const settings::Setting& setting, settings::Choices& choices);

// --width, --traversal and --kernel-dir, which several commands have.
void add_width(CLI::App& app, const std::string& what, int& lanes);
void add_traversal(CLI::App& app, render::Traversal& traversal);
void add_kernel_dir(CLI::App& app, std::filesystem::path& folder);

// --lobe, which adds reflectance models to those that ship.
void add_lobes(CLI::App& app, const std::string& help, std::vector<std::filesystem::path>& lobes);

// --device for one device, --width and --kernel-dir.
void add_one_device(CLI::App& app, std::vector<std::string>& devices, int& lanes,
                    std::filesystem::path& kernel_dir);

/// `phlux bench` and its subcommands. @throws UsageError while parsing
void add_bench(CLI::App& program, std::optional<Command>& command);

/// `phlux render`, for one scene or several. @throws UsageError while parsing
void add_render(CLI::App& program, std::optional<Command>& command);

/// `phlux info`. @throws UsageError while parsing
void add_info(CLI::App& program, std::optional<Command>& command);

/// `phlux verify`. @throws UsageError while parsing
void add_verify(CLI::App& program, std::optional<Command>& command);

} // namespace phlux::cli
