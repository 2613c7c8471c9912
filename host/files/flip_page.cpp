#include "files/flip_page.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "files/compare_picture.h"
#include "files/png.h"
#include "files/tone_map.h"

namespace phlux::files {
namespace {

constexpr int least_side = 640; // smaller images are magnified

// RFC 4648.
std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t byte = 0; byte < 3; ++byte)
      word = word << 8 | (i + byte < bytes.size() ? static_cast<unsigned char>(bytes[i + byte]) : 0U);
    for (std::size_t digit = 0; digit < 4; ++digit)
      text += i + digit > bytes.size() ? '=' : digits[word >> (18 - 6 * digit) & 63];
  }
  return text;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&' || c == '<' || c == '>' || c == '"')
      result += fmt::format("&#{};", static_cast<int>(c));
    else
      result += c;
  }
  return result;
}

Canvas picture_of(const Image& image, float exposed) {
  Canvas canvas(image.width, image.height, paper);
  draw_image(canvas, 0, 0, 1, image, exposed);
  return canvas;
}

Canvas picture_of(const std::vector<double>& differences, double scale, const Image& of) {
  Canvas canvas(of.width, of.height, paper);
  for (std::size_t pixel = 0; pixel < differences.size(); ++pixel)
    canvas.fill(static_cast<int>(pixel) % of.width, static_cast<int>(pixel) / of.width, 1, 1,
                false_color(differences[pixel] / scale));
  return canvas;
}

} // namespace

std::string flip_page(const Image& a, const Image& b, const std::string& name_a, const std::string& name_b) {
  const std::vector<double> differences = relative_differences(a, b);
  const double scale = scale_of(differences);
  const float exposed = exposure(b);
  const int zoom = std::max(1, least_side / std::max(b.width, b.height));
  const std::array<std::string, 3> titles = {escaped("A: " + name_a), escaped("B: " + name_b), "difference"};
  const std::array<Canvas, 3> pictures = {picture_of(a, exposed), picture_of(b, exposed),
                                          picture_of(differences, scale, b)};
  std::string buttons, images;
  for (std::size_t i = 0; i < titles.size(); ++i) {
    buttons += fmt::format("<button>{}</button>\n", titles[i]);
    images += fmt::format("<img alt=\"{}\" width=\"{}\" src=\"data:image/png;base64,{}\">\n", titles[i],
                          b.width * zoom, base64(encode_png(pictures[i])));
  }
  return fmt::format(R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{0}, {1}</title>
<style>
:root {{ color-scheme: light dark; font: 16px/1.5 system-ui, sans-serif; }}
body {{ margin: 1rem; }}
p {{ max-width: 46rem; }}
button {{ font: inherit; padding: .3rem .8rem; overflow-wrap: anywhere; }}
button[aria-pressed=true] {{ font-weight: bold; outline: 2px solid; }}
img {{ display: none; max-width: 100%; image-rendering: pixelated; cursor: pointer; }}
img.shown {{ display: block; }}
</style>
<p>
{2}</p>
{3}<p>The keys 1, 2 and 3 show A, B and their difference; a click on the image flips between A and B. Both have the
exposure of B. The difference is (A - B) / sqrt(B² + 1e-4) in the channel that differs most: red where A is brighter,
blue where A is darker. The colour scale ends at ±{4:g}%.</p>
<script>
const images = document.querySelectorAll("img"), buttons = document.querySelectorAll("button");
let now = 0;
function show(i) {{
  now = i;
  images.forEach((image, k) => image.classList.toggle("shown", k === i));
  buttons.forEach((button, k) => button.setAttribute("aria-pressed", k === i));
}}
buttons.forEach((button, i) => button.onclick = () => show(i));
images.forEach(image => image.onclick = () => show(now === 0 ? 1 : 0));
document.onkeydown = event => {{ if ("123".includes(event.key)) show(event.key - 1); }};
show(0);
</script>
</html>
)",
                     titles[0], titles[1], buttons, images, 100.0 * scale);
}

} // namespace phlux::files
