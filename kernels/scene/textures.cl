// Colours from textures (scene_data.h): bitmaps and checkerboards. Lookups are not filtered over a footprint: the
// samples of a pixel average over the area that it covers.
#ifndef PHLUX_TEXTURES_CL
#define PHLUX_TEXTURES_CL

#include "scene/scene.cl"

typedef struct {
  Real u, v;
} TextureCoordinates;

#define TEXTURE_REAL(scene, texture, member) GATHER_REAL((scene)->textures, texture, member)
#define TEXTURE_INT(scene, texture, member) GATHER_INT((scene)->textures, texture, member)

// Wraps a coordinate to [0, 1].
static inline Real wrapped(Real x, Int wrap) {
  const Real repeated = x - floor(x);
  const Real two_images = fma((Real)(-2.0f), floor(0.5f * x), x); // in [0, 2]: the image and its mirror image
  const Real mirrored = 1.0f - fabs(1.0f - two_images);
  const Real clamped = smaller(larger(x, (Real)(0.0f)), (Real)(1.0f));
  return wrap == WRAP_REPEAT ? repeated : wrap == WRAP_MIRROR ? mirrored : clamped;
}

// The two texels of a row or column whose centres enclose a coordinate, and its fraction of the distance between them.
typedef struct {
  Int before, after;
  Real along;
} TexelPair;

// `count` is the number of texels; indices are valid for every x, NaN included. `nearest`: both are the texel with x.
static inline TexelPair texel_pair(Real x, Int count, Int wrap, Mask nearest) {
  const Real position = fma(wrapped(x, wrap), to_real(count), nearest ? (Real)(0.0f) : (Real)(-0.5f));
  const Real below = floor(position);
  const Int last = count - 1;
  const Int first = min(max(to_int(below), (Int)(-1)), last);
  const Mask repeats = wrap == WRAP_REPEAT;
  TexelPair p;
  p.before = first < 0 ? (repeats ? last : (Int)(0)) : first;
  p.after = first == last ? (repeats ? (Int)(0) : last) : first + 1;
  p.along = nearest ? (Real)(0.0f) : position - below;
  return p;
}

// The colour of texel `index` of an image; `first` is the word where its texels begin.
static inline Vec3 byte_texel(const Scene* scene, Int first, Int index, Int decoding) {
  const Int word = gather_int((const __global int*)scene->texels, first + index);
  return vec3(gather_real(scene->texels, decoding + (word & 255)),
              gather_real(scene->texels, decoding + ((word >> 8) & 255)),
              gather_real(scene->texels, decoding + ((word >> 16) & 255)));
}
static inline Vec3 float_texel(const Scene* scene, Int first, Int index) {
  const Int word = first + 3 * index;
  return vec3(gather_real(scene->texels, word), gather_real(scene->texels, word + 1),
              gather_real(scene->texels, word + 2));
}

// For the lanes of m, whose textures are bitmaps; other lanes read valid texels too.
static inline Vec3 bitmap_colour(const Scene* scene, Int texture, Int kind, TextureCoordinates at, Mask m) {
  const Mask nearest = TEXTURE_INT(scene, texture, nearest) != 0;
  const Int width = TEXTURE_INT(scene, texture, width), first = TEXTURE_INT(scene, texture, first_word);
  const TexelPair column = texel_pair(at.u, width, TEXTURE_INT(scene, texture, wrap_u), nearest);
  const TexelPair row =
      texel_pair(at.v, TEXTURE_INT(scene, texture, height), TEXTURE_INT(scene, texture, wrap_v), nearest);
  const Mask of_bytes = kind == TEXTURE_BYTES;
  const Int decoding = TEXTURE_INT(scene, texture, decoding);
  Vec3 sum = vec_all((Real)(0.0f));
  const int corners = any_lane(m & !nearest) ? 4 : 1;
  for (int corner = 0; corner < corners; ++corner) {
    const Int x = corner & 1 ? column.after : column.before, y = corner & 2 ? row.after : row.before;
    const Real weight = (corner & 1 ? column.along : 1.0f - column.along) * (corner & 2 ? row.along : 1.0f - row.along);
    const Int index = m ? y * width + x : (Int)(0);
    Vec3 texel = vec_all((Real)(0.0f));
    if (HAS_BYTE_TEXTURES)
      texel = byte_texel(scene, of_bytes ? first : (Int)(0), of_bytes ? index : (Int)(0), decoding);
    if (HAS_FLOAT_TEXTURES) {
      const Vec3 of_floats = float_texel(scene, of_bytes ? (Int)(0) : first, of_bytes ? (Int)(0) : index);
      texel = HAS_BYTE_TEXTURES ? vec_select(of_bytes, texel, of_floats) : of_floats;
    }
    sum = vec_along(sum, weight, texel);
  }
  return vec_scale(TEXTURE_REAL(scene, texture, colors[0]), sum);
}

// The edges of the squares are 1/2 long.
static inline Vec3 checkerboard_colour(const Scene* scene, Int texture, TextureCoordinates at) {
  const Mask right = at.u - floor(at.u) > 0.5f, below = at.v - floor(at.v) > 0.5f;
  const Mask first = right == below;
  const Vec3 one = vec3(TEXTURE_REAL(scene, texture, colors[0]), TEXTURE_REAL(scene, texture, colors[1]),
                        TEXTURE_REAL(scene, texture, colors[2]));
  const Vec3 other = vec3(TEXTURE_REAL(scene, texture, colors[3]), TEXTURE_REAL(scene, texture, colors[4]),
                          TEXTURE_REAL(scene, texture, colors[5]));
  return vec_select(first, one, other);
}

// The colour of texture `number` at the coordinates of a surface, in the lanes of m.
static inline Vec3 texture_colour(const Scene* scene, Int number, TextureCoordinates surface, Mask m) {
  const Int texture = m ? number : (Int)(0);
  TextureCoordinates at;
  at.u = fma(TEXTURE_REAL(scene, texture, to_uv[0]), surface.u,
             fma(TEXTURE_REAL(scene, texture, to_uv[1]), surface.v, TEXTURE_REAL(scene, texture, to_uv[2])));
  at.v = fma(TEXTURE_REAL(scene, texture, to_uv[3]), surface.u,
             fma(TEXTURE_REAL(scene, texture, to_uv[4]), surface.v, TEXTURE_REAL(scene, texture, to_uv[5])));
  const Int kind = TEXTURE_INT(scene, texture, kind);
  if (!HAS_BITMAPS) return checkerboard_colour(scene, texture, at);
  const Mask bitmaps = m & (kind != TEXTURE_CHECKERBOARD);
  if (!HAS_CHECKERBOARDS) return bitmap_colour(scene, texture, kind, at, bitmaps);
  Vec3 colour = checkerboard_colour(scene, texture, at);
  if (any_lane(bitmaps)) colour = vec_select(bitmaps, bitmap_colour(scene, texture, kind, at, bitmaps), colour);
  return colour;
}

#endif
