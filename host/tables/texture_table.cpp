#include "tables/texture_table.h"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::tables {
namespace {

struct PlacedImage {
  int texels = 0, decoding = 0; ///< their first words
};

class Writer {
public:
  void add(const scene::Texture& texture) {
    TextureRecord record{};
    for (std::size_t i = 0; i < texture.to_uv.size(); ++i)
      record.to_uv[i] = static_cast<float>(texture.to_uv[i]);
    if (texture.image) {
      set_image(record, texture);
    } else {
      record.kind = TEXTURE_CHECKERBOARD;
      record.width = record.height = 1;
      for (int i = 0; i < 6; ++i)
        record.colors[i] =
            static_cast<float>(texture.scale * texture.colors[static_cast<std::size_t>(i / 3)][i % 3]);
    }
    table_.records.push_back(record);
  }

  TextureTable finish() { return std::move(table_); }

  const PlacedImage& place(const scene::TexelImage& image) {
    const auto [found, is_new] = placed_.try_emplace(&image);
    if (!is_new) return found->second;
    PlacedImage& at = found->second;
    if (image.bytes.empty()) {
      at.texels = append(std::as_bytes(std::span(image.floats)));
    } else {
      at.decoding = append(std::as_bytes(std::span(image.decoded)));
      at.texels = append(std::as_bytes(std::span(image.bytes)));
    }
    return at;
  }

private:
  void set_image(TextureRecord& record, const scene::Texture& texture) {
    const scene::TexelImage& image = *texture.image;
    const PlacedImage at = place(image);
    record.kind = image.bytes.empty() ? TEXTURE_FLOATS : TEXTURE_BYTES;
    record.colors[0] = static_cast<float>(texture.scale);
    record.width = image.width;
    record.height = image.height;
    record.wrap_u = wrap_of(texture.wrap_u);
    record.wrap_v = wrap_of(texture.wrap_v);
    record.nearest = texture.nearest ? 1 : 0;
    record.first_word = at.texels;
    record.decoding = at.decoding;
  }

  static int wrap_of(scene::Texture::Wrap wrap) {
    switch (wrap) {
    case scene::Texture::Wrap::repeat:
      return WRAP_REPEAT;
    case scene::Texture::Wrap::mirror:
      return WRAP_MIRROR;
    case scene::Texture::Wrap::clamp:
      break;
    }
    return WRAP_CLAMP;
  }

  int append(std::span<const std::byte> bytes) {
    const std::size_t first = table_.words;
    table_.words += bytes.size() / 4;
    if (table_.words > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw SceneError(fmt::format("the scene's textures take more than {} MB: smaller images",
                                   std::size_t{std::numeric_limits<int>::max()} / (1 << 18)));
    table_.pieces.push_back({first, bytes});
    return static_cast<int>(first);
  }

  TextureTable table_;
  std::map<const scene::TexelImage*, PlacedImage> placed_;
};

} // namespace

TextureTable texture_table(const std::vector<scene::TexturePointer>& textures) {
  Writer writer;
  // Values of bytes stand first: a kernel reads some in the lanes of other textures too.
  for (const bool bytes : {true, false})
    for (const scene::TexturePointer& texture : textures)
      if (texture->image && texture->image->bytes.empty() != bytes)
        static_cast<void>(writer.place(*texture->image));
  for (const scene::TexturePointer& texture : textures) writer.add(*texture);
  return writer.finish();
}

} // namespace phlux::tables
