#include "settings/values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "errors.h"

namespace phlux::settings {
namespace {

[[noreturn]] void wrong(const std::string& name, const std::string& text,
                        const std::string& what_would_be_right) {
  throw UsageError(fmt::format("{} {}: {}", name, text.empty() ? "''" : text, what_would_be_right));
}

template<class Number>
std::optional<Number> parse(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

// Levenshtein distance.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

} // namespace

std::uint64_t whole_number(const std::string& name, const std::string& text, std::uint64_t least,
                           std::uint64_t most) {
  const std::optional<std::uint64_t> number = parse<std::uint64_t>(text);
  if (!number || *number < least || *number > most)
    wrong(name, text, fmt::format("must be a whole number from {} to {}", least, most));
  return *number;
}

int depth(const std::string& name, const std::string& text) {
  const std::optional<int> number = parse<int>(text);
  if (!number || (*number < 1 && *number != -1))
    wrong(name, text, "must be a whole number of 1 or more, or -1 for unbounded");
  return *number;
}

double number_within(const std::string& name, const std::string& text, double least, double most) {
  const std::optional<double> number = parse<double>(text);
  if (!number || !(*number >= least && *number <= most))
    wrong(name, text, fmt::format("must be a number from {} to {}", least, most));
  return *number;
}

bool is_image_size(std::int64_t width, std::int64_t height) {
  return width >= 1 && height >= 1 && width <= longest_side && height <= longest_side &&
         width <= most_pixels / height;
}

std::string image_sizes() {
  static_assert(most_pixels == std::int64_t{1} << 28);
  return fmt::format("at most {} pixels along each side, and at most 2^28 pixels in all", longest_side);
}

std::array<int, 2> size(const std::string& name, const std::string& text) {
  const std::size_t x = text.find_first_of("xX");
  if (x != std::string::npos) {
    const std::optional<int> width = parse<int>(text.substr(0, x)), height = parse<int>(text.substr(x + 1));
    if (width && height && is_image_size(*width, *height)) return {*width, *height};
  }
  wrong(name, text, "must be WIDTHxHEIGHT in pixels, such as 640x480: " + image_sizes());
}

scene::Window window(const std::string& name, const std::string& text) {
  scene::Window window;
  const std::array<int*, 4> numbers = {&window.x, &window.y, &window.width, &window.height};
  std::istringstream parts(text);
  std::size_t count = 0;
  for (std::string part; std::getline(parts, part, ','); ++count) {
    const std::optional<int> number = parse<int>(part);
    if (count == numbers.size() || !number) break;
    *numbers[count] = *number;
  }
  if (count != numbers.size() || text.ends_with(',') || window.x < 0 || window.y < 0 ||
      !is_image_size(window.width, window.height))
    wrong(name, text,
          "must be X,Y,WIDTH,HEIGHT in pixels from the upper left corner, such as 100,50,64,48: " +
              image_sizes());
  return window;
}

std::pair<std::string, std::string> definition(const std::string& name, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) wrong(name, text, "must be NAME=VALUE");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::size_t choice(const std::string& name, const std::string& text, const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string meant = nearest(text, names);
  if (meant.empty()) wrong(name, text, "must be one of " + joined(names));
  wrong(name, text, fmt::format("did you mean {}? It must be one of {}", meant, joined(names)));
}

std::string quoted(const std::string& name) {
  return fmt::format("`{}`", name);
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string nearest(const std::string& text, const std::vector<std::string>& names) {
  std::string best;
  std::size_t least = std::min<std::size_t>(2, text.size() / 2) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = edits(text, name);
    if (distance >= least) continue;
    least = distance;
    best = name;
  }
  return best;
}

} // namespace phlux::settings
