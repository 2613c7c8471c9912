// A hash of everything that a result depends on. A later run measures again only if it has changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace phlux::bench {

/// FNV-1a, 64 bits (Fowler, Noll, Vo); not cryptographic.
class Fingerprint {
public:
  void add(const void* bytes, std::size_t size);
  void add(const std::string& text) { add(text.data(), text.size() + 1); }
  [[nodiscard]] std::string text() const; ///< 16 hexadecimal digits

private:
  std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

} // namespace phlux::bench
