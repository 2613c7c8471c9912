// What #if and #ifdef decide, as far as that is known before a compiler runs.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace phlux::device {

/// The macros that are known so far. Names that compilers define themselves (beginning with _, cl_, CL_ or
/// FP_) are unknown unless told otherwise; every other name that nobody defined is undefined.
class Macros {
public:
  Macros();
  void define(const std::string& name, const std::string& value);
  void define_opaque(const std::string& name); ///< defined, but its value cannot be used, as with parameters
  void undefine(const std::string& name);
  void forget(const std::string& name); ///< defined or not: the compiler decides

  [[nodiscard]] std::optional<bool> defined(const std::string& name) const;
  /// The replacement text; nothing when it is not known or the name is not defined.
  [[nodiscard]] std::optional<std::string> value(const std::string& name) const;

private:
  struct Macro {
    std::optional<bool> defined;
    std::optional<std::string> value;
  };
  std::map<std::string, Macro> macros_;
};

/// The truth of an #if's expression (C 6.10.1); nothing when it hangs on what is unknown or cannot be read.
[[nodiscard]] std::optional<bool> evaluate(const std::string& expression, const Macros& macros);

} // namespace phlux::device
