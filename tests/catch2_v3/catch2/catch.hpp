// Declares the names of Catch2 2, which the tests use, with Catch2 3.
#pragma once

#include <catch2/catch_all.hpp>

using Catch::Approx;

namespace Catch {

using TestEventListenerBase = EventListenerBase;

using Matchers::EndsWith;
using Matchers::Matches;
using Matchers::Message;
using Matchers::StartsWith;

// In Catch2 3 Matchers::Contains asks whether a range has an element.
inline auto Contains(const std::string& text) {
  return Matchers::ContainsSubstring(text);
}

} // namespace Catch
