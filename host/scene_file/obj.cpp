// Wavefront OBJ. Hand-written because the libraries of Debian 12 accept broken files (tinyobjloader reads
// `v abc 0 0` as the origin and does not check negative indices) or need three times the memory (assimp).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string_view>
#include <unordered_map>

#include <xxhash.h>

#include "scene_file/mesh.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

using scene::Vec3;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// One corner of a face: indices from 0; `none` if absent.
struct Corner {
  std::uint32_t position = none, texture = none, normal = none;
  bool operator==(const Corner&) const = default;
};

/// With a secret seed, so that no file can be made of corners whose hashes collide.
struct CornerHash {
  std::uint64_t seed = std::random_device()();
  std::size_t operator()(const Corner& corner) const {
    return XXH3_64bits_withSeed(&corner, sizeof corner, seed);
  }
};

class ObjReader {
public:
  explicit ObjReader(const MeshRequest& request)
      : request_(request), bytes_(read_bytes(request)),
        rest_(bytes_), where_{std::make_shared<const std::string>(request.file.string()), 1} {}

  MeshFile contents() {
    while (!rest_.empty()) {
      read_line();
      where_.line += static_cast<int>(1 + continued_lines_);
      continued_lines_ = 0;
    }
    if (unknown_lines_ > 0)
      request_.warnings->add(first_unknown_,
                             quoted(unknown_keyword_) + " is no line of a polygon mesh: " +
                                 std::to_string(unknown_lines_) + " such lines are passed over",
                             "unknown lines of obj files");
    if (!part_.mesh.triangles.empty() || part_.incomplete > 0 || file_.parts.empty()) keep_part();
    return std::move(file_);
  }

private:
  static bool ends_line(std::string_view text) { return text.starts_with('\n') || text.starts_with("\r\n"); }

  /// The next word of the line, empty at its end or at a comment. A backslash at the end joins the next line.
  std::string_view word() {
    std::size_t begin = 0;
    while (begin < rest_.size()) {
      const char c = rest_[begin];
      const auto after = rest_.substr(begin + 1);
      if (c == '\\' && ends_line(after)) {
        begin += after.starts_with('\n') ? 2 : 3;
        ++continued_lines_;
      } else if (c == ' ' || c == '\t' || c == '\r') {
        ++begin;
      } else {
        break;
      }
    }
    rest_.remove_prefix(begin);
    if (rest_.starts_with('#')) rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size())); // a comment
    auto end = std::min(rest_.find_first_of(" \t\r\n\\"), rest_.size());
    while (end < rest_.size() && rest_[end] == '\\' && !ends_line(rest_.substr(end + 1))) // part of the word
      end = std::min(rest_.find_first_of(" \t\r\n\\", end + 1), rest_.size());
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
    else if (keyword == "f" || keyword == "fo") // fo: of version 2
      face();
    else if (keyword == "mtllib")
      file_.material_library = rest_of_line();
    else if (keyword == "usemtl")
      begin_material();
    else if (keyword == "g")
      begin_group();
    else if (!has_no_polygons(keyword))
      pass_over(keyword);
    while (!word().empty()) {
    }
    skip_to_next_line();
  }

  /// What follows on the line, which may contain blanks.
  std::string rest_of_line() {
    const auto text = rest_.substr(0, rest_.find_first_of("\r\n"));
    const auto first = std::min(text.find_first_not_of(" \t"), text.size());
    return std::string(text.substr(first, text.find_last_not_of(" \t") + 1 - first));
  }

  void begin_material() {
    const std::string name = rest_of_line();
    const bool splits = request_.parts >= ObjParts::by_materials ||
                        (request_.parts == ObjParts::by_library_materials && !file_.material_library.empty());
    if (splits && (name != part_.material || request_.parts == ObjParts::by_groups)) end_part();
    if (request_.separate_groups) forget_vertices();
    part_.material = name;
  }

  void begin_group() {
    if (request_.parts == ObjParts::by_groups) end_part();
    if (request_.separate_groups) forget_vertices();
  }

  /// Corners to come share no vertices with those before.
  void forget_vertices() {
    for (const auto position : touched_) first_use_[position] = {};
    touched_.clear();
    other_uses_.clear();
  }

  /// Begins a part of the same material, unless this one has no triangles yet.
  void end_part() {
    if (part_.mesh.triangles.empty()) return;
    const std::string material = part_.material;
    keep_part();
    part_ = {};
    part_.material = material;
  }

  void keep_part() {
    if (!any_normal_) part_.mesh.normals.clear();
    if (!any_texture_coordinate_) part_.mesh.texture_coordinates.clear();
    file_.parts.push_back(std::move(part_));
    forget_vertices();
    any_normal_ = any_texture_coordinate_ = false;
  }

  /// Names, materials, smoothing groups, display attributes, points and lines.
  static bool has_no_polygons(std::string_view keyword) {
    static constexpr std::array<std::string_view, 16> keywords{
        "",  "g",  "o",     "s",   "usemap",   "maplib",   "vp",         "p",
        "l", "mg", "bevel", "lod", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
    return std::ranges::find(keywords, keyword) != keywords.end();
  }

  /// Counts a line of another kind, such as of free-form surfaces.
  void pass_over(std::string_view keyword) {
    if (++unknown_lines_ > 1) return;
    first_unknown_ = where_;
    unknown_keyword_ = keyword;
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
    if (second + 1 < rest.size()) result.normal = index(rest.substr(second + 1), normals_.size(), "normal");
    return result;
  }

  /// The mesh's vertex for this corner. As in Mitsuba, corners share a vertex if all their indices are equal,
  /// so that computed normals are not smooth across seams of the texture.
  std::uint32_t vertex(Corner corner) {
    if (request_.face_normals) corner.normal = none;
    const bool splits_normals = corner.normal == none && !request_.face_normals;
    if (!request_.texture_coordinates && !splits_normals) corner.texture = none;
    first_use_.resize(positions_.size());
    const auto created = static_cast<std::uint32_t>(part_.mesh.positions.size());
    FirstUse& first = first_use_[corner.position];
    if (first.vertex == none) {
      first = {created, corner.texture, corner.normal};
      touched_.push_back(corner.position);
    }
    const bool same = first.texture == corner.texture && first.normal == corner.normal;
    const std::uint32_t found = same ? first.vertex : other_uses_.try_emplace(corner, created).first->second;
    if (found != created) return found;
    part_.mesh.positions.push_back(positions_[corner.position]);
    any_normal_ |= corner.normal != none;
    part_.mesh.normals.push_back(corner.normal == none ? glm::vec3(0.0f) : normals_[corner.normal]);
    if (request_.texture_coordinates) {
      any_texture_coordinate_ |= corner.texture != none;
      part_.mesh.texture_coordinates.push_back(corner.texture == none ? glm::vec2(0.0f)
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
      if (corners >= 2) part_.mesh.triangles.push_back({first, previous, current});
      previous = current;
    }
    if (corners < 3) ++part_.incomplete;
  }

  struct FirstUse { ///< the first vertex of the mesh at a position
    std::uint32_t vertex = none, texture = none, normal = none;
  };

  const MeshRequest& request_;
  std::string bytes_;
  std::string_view rest_;
  Location where_;
  std::size_t continued_lines_ = 0, texture_coordinate_count_ = 0;
  bool any_normal_ = false, any_texture_coordinate_ = false;
  std::vector<Vec3> positions_;
  std::vector<glm::vec3> normals_;
  std::vector<glm::vec2> texture_coordinates_; ///< empty unless the request wants them
  std::vector<FirstUse> first_use_;            ///< by position
  std::unordered_map<Corner, std::uint32_t, CornerHash> other_uses_;
  std::vector<std::uint32_t> touched_; ///< positions that the part has used
  std::size_t unknown_lines_ = 0;
  Location first_unknown_;
  std::string_view unknown_keyword_;
  MeshPart part_; ///< the one that is being read
  MeshFile file_;
};

} // namespace

MeshFile load_obj(const MeshRequest& request) {
  return ObjReader(request).contents();
}

} // namespace phlux::scene_file
