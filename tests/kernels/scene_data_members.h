// Every member of every struct shared by host and kernels, to compare its offset in both compilers.
#define SHARED_STRUCTS(STRUCT)                                                                               \
  STRUCT(PrimitiveRecord)                                                                                    \
  STRUCT(LightRecord)                                                                                        \
  STRUCT(LightNodeRecord)                                                                                    \
  STRUCT(CameraRecord) STRUCT(TextureRecord) STRUCT(EnvironmentRecord) STRUCT(EnvironmentTexel)

#define SHARED_MEMBERS(MEMBER)                                                                               \
  MEMBER(PrimitiveRecord, material)                                                                          \
  MEMBER(PrimitiveRecord, light)                                                                             \
  MEMBER(PrimitiveRecord, region)                                                                            \
  MEMBER(LightRecord, kind)                                                                                  \
  MEMBER(LightRecord, primitive)                                                                             \
  MEMBER(LightRecord, radiance)                                                                              \
  MEMBER(LightRecord, area)                                                                                  \
  MEMBER(LightRecord, position)                                                                              \
  MEMBER(LightRecord, direction)                                                                             \
  MEMBER(LightRecord, cutoff)                                                                                \
  MEMBER(LightRecord, inv_transition)                                                                        \
  MEMBER(LightRecord, probability)                                                                           \
  MEMBER(LightRecord, sample_probability)                                                                    \
  MEMBER(LightRecord, emission_density)                                                                      \
  MEMBER(LightRecord, alias_threshold)                                                                       \
  MEMBER(LightRecord, alias)                                                                                 \
  MEMBER(LightRecord, node)                                                                                  \
  MEMBER(LightNodeRecord, center)                                                                            \
  MEMBER(LightNodeRecord, half_size)                                                                         \
  MEMBER(LightNodeRecord, axis)                                                                              \
  MEMBER(LightNodeRecord, cos_spread)                                                                        \
  MEMBER(LightNodeRecord, intensity)                                                                         \
  MEMBER(LightNodeRecord, parent)                                                                            \
  MEMBER(LightNodeRecord, child)                                                                             \
  MEMBER(CameraRecord, position)                                                                             \
  MEMBER(CameraRecord, forward)                                                                              \
  MEMBER(CameraRecord, left)                                                                                 \
  MEMBER(CameraRecord, up)                                                                                   \
  MEMBER(CameraRecord, principal_x)                                                                          \
  MEMBER(CameraRecord, principal_y)                                                                          \
  MEMBER(CameraRecord, film_area)                                                                            \
  MEMBER(CameraRecord, lens)                                                                                 \
  MEMBER(CameraRecord, inv_focus_distance)                                                                   \
  MEMBER(CameraRecord, filter_size)                                                                          \
  MEMBER(EnvironmentRecord, x)                                                                               \
  MEMBER(EnvironmentRecord, y)                                                                               \
  MEMBER(EnvironmentRecord, z)                                                                               \
  MEMBER(EnvironmentRecord, density)                                                                         \
  MEMBER(EnvironmentRecord, cap)                                                                             \
  MEMBER(EnvironmentRecord, cap_share)                                                                       \
  MEMBER(EnvironmentRecord, width)                                                                           \
  MEMBER(EnvironmentRecord, height)                                                                          \
  MEMBER(EnvironmentTexel, radiance)                                                                         \
  MEMBER(EnvironmentTexel, threshold)                                                                        \
  MEMBER(EnvironmentTexel, alias)                                                                            \
  MEMBER(CameraRecord, width)                                                                                \
  MEMBER(CameraRecord, height)                                                                               \
  MEMBER(TextureRecord, kind)                                                                                \
  MEMBER(TextureRecord, to_uv)                                                                               \
  MEMBER(TextureRecord, colors)                                                                              \
  MEMBER(TextureRecord, width)                                                                               \
  MEMBER(TextureRecord, height)                                                                              \
  MEMBER(TextureRecord, wrap_u)                                                                              \
  MEMBER(TextureRecord, wrap_v)                                                                              \
  MEMBER(TextureRecord, nearest)                                                                             \
  MEMBER(TextureRecord, first_word)                                                                          \
  MEMBER(TextureRecord, decoding)
