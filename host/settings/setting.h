// One setting of a render. Options, messages and files use the list of settings in settings.h.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "scene/scene.h"
#include "settings/strategies.h"
#include "settings/values.h"

namespace phlux::settings {

struct Settings;

/// The property of a render that a setting changes. If it is execution, images differ by rounding only.
enum class Affects {
  expectation, ///< the image that a render converges to
  estimate,    ///< the noise
  film,        ///< what is stored besides the image
  samples,     ///< which samples are taken
  amount,      ///< the number of samples
  execution    ///< where and how kernels run
};

/// std::monostate: absent.
using Value = std::variant<std::monostate, std::string, std::int64_t, std::uint64_t, double>;
/// A text from which read() gets the same value; empty if absent.
[[nodiscard]] std::string text_of(const Value& value);

// Domains of settings. read() takes the setting's name in messages, and its text.
struct OneOf { ///< one of these names; the member is the name, an enum of its index, or an int of its digits
  std::vector<std::string> names;

  template<class T>
  [[nodiscard]] T read(const std::string& name, const std::string& text) const {
    const std::size_t index = choice(name, text, names);
    if constexpr (std::is_same_v<T, std::string>)
      return names[index];
    else if constexpr (std::is_same_v<T, int>)
      return std::stoi(names[index]);
    else
      return static_cast<T>(index);
  }
  template<class T>
  [[nodiscard]] Value value(const T& of) const {
    if constexpr (std::is_same_v<T, std::string>)
      return of;
    else if constexpr (std::is_same_v<T, int>)
      return of == 0 ? Value() : std::to_string(of);
    else
      return names.at(static_cast<std::size_t>(of));
  }
};
struct StrategyOrFile { ///< the name of a strategy, or a user's kernel file
  std::vector<std::string> names = strategy_names();

  template<class T>
  [[nodiscard]] T read(const std::string& name, const std::string& text) const {
    return strategy(name, text);
  }
  [[nodiscard]] Value value(const std::string& of) const { return of; }
};
struct Switch { ///< on or off, without an option of its own; `on` is its text if on
  const char* on;

  template<class T>
  [[nodiscard]] T read(const std::string&, const std::string& text) const {
    return !text.empty();
  }
  [[nodiscard]] Value value(bool of) const { return of ? Value(on) : Value(); }
};
struct Number {
  [[nodiscard]] static Value value(const std::optional<double>& of) { return of ? Value(*of) : Value(); }
  [[nodiscard]] static Value value(std::uint64_t of) { return of; }
  [[nodiscard]] static Value value(const std::optional<int>& of) {
    return of ? Value(std::int64_t{*of}) : Value();
  }
  template<class T>
  [[nodiscard]] static Value value(const T& of) {
    return static_cast<std::int64_t>(of);
  }
};
struct Whole : Number {
  std::uint64_t least, most;
  Whole(std::uint64_t from, std::uint64_t to) : least(from), most(to) {}
  template<class T>
  [[nodiscard]] T read(const std::string& name, const std::string& text) const {
    return static_cast<T>(whole_number(name, text, least, most));
  }
};
struct Depth : Number { ///< 1 or more, or -1 for unbounded
  template<class T>
  [[nodiscard]] T read(const std::string& name, const std::string& text) const {
    return depth(name, text);
  }
};
struct Within : Number { ///< from `least` to `most`
  double least, most;
  Within(double from, double to) : least(from), most(to) {}
  template<class T>
  [[nodiscard]] T read(const std::string& name, const std::string& text) const {
    return number_within(name, text, least, most);
  }
};

struct Crop { ///< a part of the image
  template<class T>
  [[nodiscard]] static T read(const std::string& name, const std::string& text) {
    return window(name, text);
  }
  [[nodiscard]] static Value value(const std::optional<scene::Window>& of);
};

struct Setting {
  std::string name; ///< "rr-depth"
  Affects affects;
  std::string placeholder; ///< for its value in help, such as "N"
  std::string help;        ///< without the default; empty: no option sets it

  /// @throws UsageError "`NAME` TEXT: what would be right"
  std::function<void(const std::string& text, Settings& to)> read;
  std::function<Value(const Settings& of)> value;
  std::function<void(const Settings& from, Settings& to)> copy;
  std::vector<std::string> choices; ///< names that are values, for completion; empty: others
  /// Empty: not in scene files.
  std::function<void(const scene::RenderDefaults& from, Settings& to)> from_scene;

  /// A chosen setting must have an effect. If `holds` is false, the error is "`NAME`" and `otherwise`, in
  /// which {} is the integrator's name.
  struct Condition {
    std::function<bool(const Settings&)> holds;
    std::string otherwise;
  };
  std::vector<Condition> conditions;

  template<class T, class Domain>
  Setting(std::string setting_name, Affects what, T Settings::*member, Domain domain,
          std::string value_placeholder, std::string help_text)
      : name(std::move(setting_name)), affects(what), placeholder(std::move(value_placeholder)),
        help(std::move(help_text)),
        read([member, domain, label = settings::quoted(name)](const std::string& text, Settings& to) {
          to.*member = domain.template read<T>(label, text);
        }),
        value([member, domain](const Settings& of) { return domain.value(of.*member); }),
        copy([member](const Settings& from, Settings& to) { to.*member = from.*member; }) {
    if constexpr (requires { domain.names; }) choices = domain.names;
  }

  /// The default is the scene's.
  template<class T>
  [[nodiscard]] Setting or_scene(T Settings::*member, T scene::RenderDefaults::*of) && {
    from_scene = [member, of](const scene::RenderDefaults& from, Settings& to) { to.*member = from.*of; };
    return std::move(*this);
  }
  [[nodiscard]] Setting only_where(std::function<bool(const Settings&)> holds, std::string otherwise) && {
    conditions.push_back({std::move(holds), std::move(otherwise)});
    return std::move(*this);
  }

  [[nodiscard]] std::string text(const Settings& of) const { return text_of(value(of)); }
};

} // namespace phlux::settings
