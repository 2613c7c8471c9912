// Wavefront OBJ. Hand-written because the libraries of Debian 12 accept broken files (tinyobjloader reads
// `v abc 0 0` as the origin and does not check negative indices) or need three times the memory (assimp).
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "scene_file/mesh.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

using scene::Vec3;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// One corner of a face: indices from 0; `none` if absent.
struct Corner {
  std::uint32_t position = none, texture = none, normal = none;
};

class ObjReader {
public:
  explicit ObjReader(const MeshRequest& request)
      : request_(request), bytes_(read_bytes(request)),
        rest_(bytes_), where_{std::make_shared<const std::string>(request.file.string()), 1} {}

  /// In object space. `dropped` counts faces with fewer than three corners.
  scene::Mesh mesh(std::size_t& dropped) {
    while (!rest_.empty()) {
      read_line();
      where_.line += static_cast<int>(1 + continued_lines_);
      continued_lines_ = 0;
    }
    dropped = dropped_;
    if (!any_normal_) mesh_.normals.clear();
    if (!any_texture_coordinate_) mesh_.texture_coordinates.clear();
    return std::move(mesh_);
  }

private:
  /// The next word of the line, empty at its end or at a comment. A backslash at the end joins the next line.
  std::string_view word() {
    std::size_t begin = 0;
    while (begin < rest_.size()) {
      const char c = rest_[begin];
      const auto after = rest_.substr(begin + 1);
      const std::size_t line_end = after.starts_with('\n') ? 1 : after.starts_with("\r\n") ? 2 : 0;
      if (c == '\\' && line_end > 0) {
        begin += line_end + 1;
        ++continued_lines_;
      } else if (c == ' ' || c == '\t' || c == '\r') {
        ++begin;
      } else {
        break;
      }
    }
    rest_.remove_prefix(begin);
    if (rest_.starts_with('#')) rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size())); // a comment
    const auto end = std::min(rest_.find_first_of(" \t\r\n\\"), rest_.size());
    const auto result = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return result;
  }

  void read_line() {
    const auto keyword = word();
    if (keyword == "v")
      positions_.push_back(vector("vertex"));
    else if (keyword == "vn" && !request_.face_normals)
      normals_.push_back(glm::vec3(vector("normal")));
    else if (keyword == "vn")
      normals_.emplace_back();
    else if (keyword == "vt")
      texture_coordinate();
    else if (keyword == "f")
      face();
    else if (keyword == "mtllib")
      warn(where_, "materials of OBJ files are not read; the shape's bsdf is used");
    while (!word().empty()) {
    }
    skip_to_next_line();
  }

  void skip_to_next_line() {
    const auto end = rest_.find('\n');
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  }

  Vec3 vector(const char* what) {
    Vec3 result;
    for (int i = 0; i < 3; ++i) {
      const auto text = word();
      const auto value = parse_real(text);
      if (!value)
        fail(where_, std::string(what) + " with " + quoted(text) + " for a coordinate",
             "three finite numbers within single precision");
      result[i] = *value;
    }
    return result;
  }

  /// u and, where it is not 0, v.
  void texture_coordinate() {
    ++texture_coordinate_count_;
    if (!request_.texture_coordinates) return;
    glm::dvec2 result(0.0);
    for (int i = 0; i < 2; ++i) {
      const auto text = word();
      const auto value = parse_real(text);
      if (!value && (i == 0 || !text.empty()))
        fail(where_, "texture coordinate with " + quoted(text) + " for a number",
             "finite numbers within single precision");
      result[i] = value.value_or(0.0);
    }
    if (request_.flip_tex_coords) result.y = 1 - result.y;
    texture_coordinates_.emplace_back(result);
  }

  /// Index from 0 of `text`, which counts from 1, or backwards from -1.
  std::uint32_t index(std::string_view text, std::size_t count, const char* what) {
    const auto value = parse_integer(text);
    if (!value)
      fail(where_, quoted(text) + " is no index", "faces like 1 2 3, 1/1 2/2 3/3 or 1//1 2//2 3//3");
    const auto size = static_cast<long long>(count);
    const long long from_zero = *value > 0 ? *value - 1LL : size + *value;
    if (*value == 0 || from_zero < 0 || from_zero >= size)
      fail(where_, "index " + std::string(text) + " of a " + what + " is out of range",
           std::to_string(count) + " were given before it");
    return static_cast<std::uint32_t>(from_zero);
  }

  Corner corner(std::string_view text) {
    Corner result;
    const auto first = std::min(text.find('/'), text.size());
    result.position = index(text.substr(0, first), positions_.size(), "vertex");
    if (first == text.size()) return result;
    const auto rest = text.substr(first + 1);
    const auto second = std::min(rest.find('/'), rest.size());
    if (second > 0)
      result.texture = index(rest.substr(0, second), texture_coordinate_count_, "texture coordinate");
    if (second < rest.size()) result.normal = index(rest.substr(second + 1), normals_.size(), "normal");
    return result;
  }

  /// The mesh's vertex for this corner. As in Mitsuba, corners share a vertex if all their indices are equal,
  /// so that computed normals are not smooth across seams of the texture.
  std::uint32_t vertex(Corner corner) {
    if (request_.face_normals) corner.normal = none;
    const bool splits_normals = corner.normal == none && !request_.face_normals;
    if (!request_.texture_coordinates && !splits_normals) corner.texture = none;
    first_use_.resize(positions_.size(), none);
    std::uint32_t* link = &first_use_[corner.position];
    for (; *link != none; link = &uses_[*link].next)
      if (uses_[*link].texture == corner.texture && uses_[*link].normal == corner.normal) return *link;
    const auto created = static_cast<std::uint32_t>(uses_.size());
    *link = created; // before uses_ is reallocated
    uses_.push_back({corner.texture, corner.normal, none});
    mesh_.positions.push_back(positions_[corner.position]);
    any_normal_ |= corner.normal != none;
    mesh_.normals.push_back(corner.normal == none ? glm::vec3(0.0f) : normals_[corner.normal]);
    if (request_.texture_coordinates) {
      any_texture_coordinate_ |= corner.texture != none;
      mesh_.texture_coordinates.push_back(corner.texture == none ? glm::vec2(0.0f)
                                                                 : texture_coordinates_[corner.texture]);
    }
    return created;
  }

  /// A fan of triangles around the first corner, correct for convex polygons.
  void face() {
    std::size_t corners = 0;
    std::uint32_t first = none, previous = none;
    for (auto text = word(); !text.empty(); text = word(), ++corners) {
      const std::uint32_t current = vertex(corner(text));
      if (corners == 0) first = current;
      if (corners >= 2) mesh_.triangles.push_back({first, previous, current});
      previous = current;
    }
    if (corners < 3) ++dropped_;
  }

  struct Use { ///< one of the vertices that share a position
    std::uint32_t texture, normal, next;
  };

  const MeshRequest& request_;
  std::string bytes_;
  std::string_view rest_;
  Location where_;
  std::size_t continued_lines_ = 0, texture_coordinate_count_ = 0, dropped_ = 0;
  bool any_normal_ = false, any_texture_coordinate_ = false;
  std::vector<Vec3> positions_;
  std::vector<glm::vec3> normals_;
  std::vector<glm::vec2> texture_coordinates_; ///< empty unless the request wants them
  std::vector<std::uint32_t> first_use_;       ///< by position: the first of a chain through uses_
  std::vector<Use> uses_;                      ///< by vertex of the mesh
  scene::Mesh mesh_;
};

} // namespace

scene::Mesh load_obj(const MeshRequest& request) {
  std::size_t dropped = 0;
  scene::Mesh mesh = ObjReader(request).mesh(dropped); // releases the reader's memory
  return finish_mesh(std::move(mesh), request, dropped);
}

} // namespace phlux::scene_file
