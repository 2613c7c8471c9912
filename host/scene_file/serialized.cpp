// Mitsuba's binary meshes (the documentation of its plugin `serialized` states the format): one after
// another, each a header of two words and a zlib stream; the file ends with the offsets of all meshes and
// their number.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <span>

#include <zlib.h>

#include "scene_file/mesh.h"

namespace phlux::scene_file {

namespace {

constexpr std::uint16_t file_mark = 0x041C;
/// Flags of a mesh.
constexpr std::uint32_t has_normals = 0x1, has_texture = 0x2, has_colours = 0x8, is_flat = 0x10,
                        in_double = 0x2000;
/// Bytes that one byte of a zlib stream can become, at most (RFC 1951; zlib's documentation).
constexpr std::uint64_t largest_expansion = 1032;

/// The little-endian number in `bytes`.
template<std::unsigned_integral Number>
Number little_endian(std::span<const unsigned char> bytes) {
  Number number = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    number = static_cast<Number>(number | static_cast<Number>(static_cast<Number>(bytes[i]) << (8 * i)));
  return number;
}

class SerializedFile {
public:
  explicit SerializedFile(const MeshRequest& request)
      : where_{std::make_shared<const std::string>(request.file.string()), 0} {
    std::error_code error;
    if (std::filesystem::is_regular_file(request.file, error)) stream_.open(request.file, std::ios::binary);
    size_ = std::filesystem::file_size(request.file, error);
    if (error || !stream_.is_open())
      fail(request.named_at, "mesh file '" + request.file.string() + "' cannot be read",
           "an existing file, named relative to the scene's folder");
  }

  [[nodiscard]] const Location& where() const { return where_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  template<std::unsigned_integral Number>
  Number number_at(std::uint64_t offset) {
    std::array<unsigned char, sizeof(Number)> bytes{};
    if (size_ < sizeof(Number) || offset > size_ - sizeof(Number)) fail_short();
    stream_.seekg(static_cast<std::streamoff>(offset));
    read(bytes);
    return little_endian<Number>(bytes);
  }

  /// Reads as many bytes as there are, up to the size of `bytes`, from behind those read last.
  std::size_t read(std::span<unsigned char> bytes) {
    stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const auto count = static_cast<std::size_t>(stream_.gcount());
    stream_.clear();
    return count;
  }

  [[noreturn]] void fail_short() const { fail(where_, "the file is cut short", "a whole serialized mesh"); }

private:
  Location where_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

/// The content of a zlib stream, from the file's position on.
class Inflated {
public:
  explicit Inflated(SerializedFile& file) : file_(file) {
    if (inflateInit(&state_) != Z_OK) throw std::bad_alloc();
  }
  ~Inflated() { inflateEnd(&state_); }
  Inflated(const Inflated&) = delete;
  Inflated& operator=(const Inflated&) = delete;

  void read(std::span<unsigned char> bytes) {
    while (!bytes.empty()) {
      if (state_.avail_in == 0) {
        state_.avail_in = static_cast<uInt>(file_.read(buffer_));
        state_.next_in = buffer_.data();
        if (state_.avail_in == 0) file_.fail_short();
      }
      const std::size_t wanted = std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max());
      state_.next_out = bytes.data();
      state_.avail_out = static_cast<uInt>(wanted);
      const int result = inflate(&state_, Z_NO_FLUSH);
      bytes = bytes.subspan(wanted - state_.avail_out);
      if (result == Z_STREAM_END && !bytes.empty()) file_.fail_short();
      if (result != Z_OK && result != Z_STREAM_END)
        fail(file_.where(), "the compressed data is damaged", "a whole serialized mesh");
    }
  }

  template<std::unsigned_integral Number>
  Number number() {
    std::array<unsigned char, sizeof(Number)> bytes{};
    read(bytes);
    return little_endian<Number>(bytes);
  }

  double real(bool is_double) {
    return is_double ? std::bit_cast<double>(number<std::uint64_t>())
                     : static_cast<double>(std::bit_cast<float>(number<std::uint32_t>()));
  }

private:
  SerializedFile& file_;
  z_stream state_{};
  std::array<unsigned char, 1 << 16> buffer_{};
};

/// Position of mesh `index`, from the dictionary at the end of the file.
std::uint64_t offset_of(SerializedFile& file, int index) {
  if (index <= 0) return 0;
  const auto version = file.number_at<std::uint16_t>(2);
  const auto count = file.number_at<std::uint32_t>(std::max<std::uint64_t>(file.size(), 4) - 4);
  const std::uint64_t word = version >= 4 ? 8 : 4;
  if (static_cast<std::uint32_t>(index) >= count || count > file.size() / word)
    fail(file.where(), "the file has no mesh " + std::to_string(index),
         "a shape index from 0 to " + std::to_string(std::max(count, 1U) - 1));
  const std::uint64_t at = file.size() - 4 - (count - static_cast<std::uint32_t>(index)) * word;
  return version >= 4 ? file.number_at<std::uint64_t>(at) : file.number_at<std::uint32_t>(at);
}

class SerializedReader {
public:
  explicit SerializedReader(const MeshRequest& request) : request_(request), file_(request) {}

  MeshPart part() {
    const std::uint64_t offset = offset_of(file_, request_.shape_index);
    if (file_.number_at<std::uint16_t>(offset) != file_mark)
      fail(file_.where(), "not a serialized mesh", "a file that begins with the bytes 1C 04");
    const auto version = file_.number_at<std::uint16_t>(offset + 2);
    if (version != 3 && version != 4)
      fail(file_.where(), "version " + std::to_string(version) + " of the format is not supported", "3 or 4");
    Inflated content(file_);
    const auto flags = content.number<std::uint32_t>();
    while (version == 4 && content.number<std::uint8_t>() != 0) { // the mesh's name
    }
    const std::uint64_t vertices = count(content), triangles = count(content);
    const bool is_double = (flags & in_double) != 0;
    MeshPart part;
    part.face_normals = (flags & is_flat) != 0;
    for (std::uint64_t i = 0; i < vertices; ++i) part.mesh.positions.push_back(vector(content, is_double));
    if (flags & has_normals)
      for (std::uint64_t i = 0; i < vertices; ++i) part.mesh.normals.emplace_back(vector(content, is_double));
    if (flags & has_texture)
      for (std::uint64_t i = 0; i < vertices; ++i) add_texture_coordinates(content, is_double, part.mesh);
    if (flags & has_colours)
      for (std::uint64_t i = 0; i < 3 * vertices; ++i) static_cast<void>(content.real(is_double));
    for (std::uint64_t i = 0; i < triangles; ++i) {
      std::array<std::uint32_t, 3> triangle{};
      for (auto& corner : triangle) corner = index(content, vertices);
      part.mesh.triangles.push_back(triangle);
    }
    return part;
  }

private:
  /// A number of vertices or triangles, which take 12 bytes or more each.
  std::uint64_t count(Inflated& content) {
    const auto number = content.number<std::uint64_t>();
    if (number >= std::numeric_limits<std::uint32_t>::max() || number > file_.size() * largest_expansion / 12)
      fail(file_.where(), "a mesh of " + std::to_string(number) + " vertices or triangles",
           "less than 2^32, and no more than a file of its size can hold");
    return number;
  }

  scene::Vec3 vector(Inflated& content, bool is_double) {
    scene::Vec3 result;
    for (int axis = 0; axis < 3; ++axis) {
      result[axis] = content.real(is_double);
      if (!(std::abs(result[axis]) <= std::numeric_limits<float>::max()))
        fail(file_.where(), "a vertex or normal is not finite", "numbers within single precision");
    }
    return result;
  }

  void add_texture_coordinates(Inflated& content, bool is_double, scene::Mesh& mesh) {
    const double u = content.real(is_double), v = content.real(is_double);
    if (!request_.texture_coordinates) return;
    const glm::vec2 uv(u, request_.flip_tex_coords ? 1.0 - v : v);
    if (!std::isfinite(uv.x + uv.y))
      fail(file_.where(), "a texture coordinate is not finite", "finite numbers");
    mesh.texture_coordinates.push_back(uv);
  }

  std::uint32_t index(Inflated& content, std::uint64_t vertices) {
    const auto number = content.number<std::uint32_t>();
    if (number >= vertices)
      fail(file_.where(), "a triangle has a vertex index out of range",
           "0 to " + std::to_string(vertices - 1) + " (vertices - 1)");
    return number;
  }

  const MeshRequest& request_;
  SerializedFile file_;
};

} // namespace

MeshFile load_serialized(const MeshRequest& request) {
  MeshFile file;
  file.parts.push_back(SerializedReader(request).part());
  return file;
}

} // namespace phlux::scene_file
