// Stanford PLY. Hand-written because assimp 5.2.5, the only library of Debian 12 that reads PLY, hangs on a
// truncated header, aborts on binary files whose data begin with a line end, and accepts truncated ascii
// files.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "scene_file/mesh.h"
#include "scene_file/ply_header.h"
#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

/// Reads consecutive numbers of any format.
class PlyNumbers {
public:
  PlyNumbers(std::string_view bytes, const PlyHeader& header, Location where)
      : at_(bytes.data() + header.size), end_(bytes.data() + bytes.size()), format_(header.format),
        where_(std::move(where)) {
    if (ascii()) where_.line = header.lines + 1;
  }

  [[nodiscard]] bool ascii() const { return format_ == PlyHeader::Format::ascii; }
  [[nodiscard]] std::uint64_t bytes_left() const { return static_cast<std::uint64_t>(end_ - at_); }
  /// With a line in ascii files only.
  [[nodiscard]] const Location& where() const { return where_; }

  double next(PlyType type) { return ascii() ? next_word() : next_binary(type); }

  /// The number of entries of a list.
  std::uint64_t next_count(PlyType type) {
    const double count = next(type);
    if (!(count >= 0.0 && count <= std::numeric_limits<std::uint32_t>::max() && count == std::floor(count)))
      fail(where_, "a list of " + std::to_string(count) + " entries", "a whole number of 0 or more");
    return static_cast<std::uint64_t>(count);
  }

  void skip_blanks() {
    for (; at_ != end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\r' || *at_ == '\n'); ++at_)
      if (*at_ == '\n') ++where_.line;
  }

  [[noreturn]] void truncated() const {
    fail(where_, "the file is cut short", "as many rows as the PLY header announces");
  }

private:
  double next_word() {
    skip_blanks();
    if (at_ == end_) truncated();
    const auto word_end =
        std::find_if(at_, end_, [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; });
    const std::string_view word(at_, word_end);
    const auto value = parse_number(word);
    if (!value) fail(where_, quoted(word) + " is not a number", "a finite number");
    at_ = word_end;
    return *value;
  }

  double next_binary(PlyType type) {
    switch (type) {
    case PlyType::int8:
      return raw<std::int8_t>();
    case PlyType::uint8:
      return raw<std::uint8_t>();
    case PlyType::int16:
      return raw<std::int16_t>();
    case PlyType::uint16:
      return raw<std::uint16_t>();
    case PlyType::int32:
      return raw<std::int32_t>();
    case PlyType::uint32:
      return raw<std::uint32_t>();
    case PlyType::float32:
      return static_cast<double>(raw<float>());
    case PlyType::float64:
      return raw<double>();
    }
    return 0.0;
  }

  template<class Number>
  Number raw() {
    if (bytes_left() < sizeof(Number)) truncated();
    char bytes[sizeof(Number)];
    std::memcpy(bytes, at_, sizeof(Number));
    at_ += sizeof(Number);
    const bool same =
        (format_ == PlyHeader::Format::little_endian) == (std::endian::native == std::endian::little);
    if (!same) std::reverse(std::begin(bytes), std::end(bytes));
    return std::bit_cast<Number>(bytes);
  }

  const char* at_;
  const char* end_;
  PlyHeader::Format format_;
  Location where_;
};

class PlyReader {
public:
  PlyReader(std::string_view bytes, const PlyHeader& header, const Location& where,
            const MeshRequest& request)
      : header_(header), where_(where), request_(request), numbers_(bytes, header, where) {}

  /// In object space. `incomplete` counts faces with fewer than three corners, which are left out.
  scene::Mesh mesh(std::size_t& incomplete) {
    vertices_ = element("vertex").rows;
    static_cast<void>(element("face"));
    if (vertices_ >= std::numeric_limits<std::uint32_t>::max())
      fail(where_, "too many vertices", "fewer than 2^32");
    for (const auto& element : header_.elements) {
      check_size(element);
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else
        skip(element);
    }
    if (numbers_.ascii()) numbers_.skip_blanks();
    if (numbers_.bytes_left() > 0)
      fail(numbers_.where(), "data after the last row", "as many rows as the PLY header announces");
    incomplete = incomplete_;
    return std::move(mesh_);
  }

private:
  const PlyElement& element(const char* name) const {
    const auto named = [name](const PlyElement& e) { return e.name == name; };
    if (std::ranges::count_if(header_.elements, named) != 1)
      fail(where_, std::string("the PLY header needs one element ") + name,
           "vertices (x, y, z) and faces (vertex_indices)");
    return *std::ranges::find_if(header_.elements, named);
  }

  /// Fails if the file is too short for the rows, before memory is reserved for them.
  void check_size(const PlyElement& element) const {
    std::uint64_t least = 0;
    for (const auto& property : element.properties)
      least += numbers_.ascii() ? 1 : byte_size(property.count_type.value_or(property.type));
    if (least > 0 && element.rows > numbers_.bytes_left() / least + 1) numbers_.truncated();
  }

  void skip_property(const PlyProperty& property) {
    const std::uint64_t entries = property.count_type ? numbers_.next_count(*property.count_type) : 1;
    for (std::uint64_t i = 0; i < entries; ++i) numbers_.next(property.type);
  }

  void skip(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t row = 0; row < element.rows; ++row)
      for (const auto& property : element.properties) skip_property(property);
  }

  static constexpr std::size_t row_numbers = 9; ///< x, y, z, nx, ny, nz, u, v and an ignored one

  static std::size_t slot_of(const std::string& name) {
    static constexpr std::array<std::string_view, 8> names{"x", "y", "z", "nx", "ny", "nz", "u", "v"};
    if (name == "s" || name == "texture_u") return 6;
    if (name == "t" || name == "texture_v") return 7;
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  }

  void read_vertices(const PlyElement& element) {
    std::vector<std::size_t> slots; // per property, index into `row`; the last one for ignored numbers
    std::array<bool, row_numbers> given{};
    for (const auto& property : element.properties) {
      slots.push_back(property.count_type ? row_numbers - 1 : slot_of(property.name));
      given[slots.back()] = true;
    }
    if (!given[0] || !given[1] || !given[2])
      fail({where_.file, element.line}, "vertices without x, y or z", "all three");
    const bool normals = given[3] && given[4] && given[5];
    mesh_.positions.reserve(element.rows);
    if (normals) mesh_.normals.reserve(element.rows);
    with_uv_ = request_.texture_coordinates && given[6] && given[7];
    std::array<double, row_numbers> row{};
    for (std::uint64_t i = 0; i < element.rows; ++i) {
      for (std::size_t p = 0; p < slots.size(); ++p) {
        const auto& property = element.properties[p];
        if (property.count_type)
          skip_property(property);
        else
          row[slots[p]] = numbers_.next(property.type);
      }
      add_vertex(row, normals);
    }
  }

  void add_vertex(const std::array<double, row_numbers>& row, bool normals) {
    const auto index = mesh_.positions.size();
    for (std::size_t k = 0; k < 3; ++k)
      if (!(std::abs(row[k]) <= std::numeric_limits<float>::max()))
        fail(numbers_.where(), "vertex " + std::to_string(index) + " is not finite",
             "coordinates within single precision");
    mesh_.positions.emplace_back(row[0], row[1], row[2]);
    if (with_uv_) {
      const glm::vec2 uv(row[6], request_.flip_tex_coords ? 1 - row[7] : row[7]);
      if (!std::isfinite(uv.x + uv.y))
        fail(numbers_.where(), "texture coordinate " + std::to_string(index) + " is not finite",
             "finite numbers");
      mesh_.texture_coordinates.push_back(uv);
    }
    if (!normals) return;
    const glm::vec3 normal(row[3], row[4], row[5]);
    if (!std::isfinite(normal.x + normal.y + normal.z))
      fail(numbers_.where(), "normal " + std::to_string(index) + " is not finite", "finite numbers");
    mesh_.normals.push_back(normal);
  }

  void read_faces(const PlyElement& element) {
    const auto holds_indices = [](const PlyProperty& p) {
      return p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    if (std::ranges::count_if(element.properties, holds_indices) != 1)
      fail({where_.file, element.line}, "faces without vertex_indices",
           "property list uchar int vertex_indices");
    mesh_.triangles.reserve(element.rows);
    for (std::uint64_t i = 0; i < element.rows; ++i)
      for (const auto& property : element.properties) {
        if (holds_indices(property))
          read_face(i, property);
        else
          skip_property(property);
      }
  }

  /// A fan of triangles around the first corner, correct for convex polygons.
  void read_face(std::uint64_t row, const PlyProperty& property) {
    const std::uint64_t corners = numbers_.next_count(*property.count_type);
    std::uint32_t first = 0, previous = 0;
    for (std::uint64_t k = 0; k < corners; ++k) {
      const double value = numbers_.next(property.type);
      if (!(value >= 0.0 && value < static_cast<double>(vertices_) && value == std::floor(value)))
        fail(numbers_.where(), "face " + std::to_string(row) + " has a vertex index out of range",
             "0 to " + std::to_string(vertices_ - 1) + " (vertices - 1)");
      const auto index = static_cast<std::uint32_t>(value);
      if (k == 0) first = index;
      if (k >= 2) mesh_.triangles.push_back({first, previous, index});
      previous = index;
    }
    if (corners < 3) ++incomplete_;
  }

  const PlyHeader& header_;
  const Location& where_;
  const MeshRequest& request_;
  bool with_uv_ = false;
  PlyNumbers numbers_;
  std::uint64_t vertices_ = 0;
  std::size_t incomplete_ = 0;
  scene::Mesh mesh_;
};

} // namespace

MeshFile load_ply(const MeshRequest& request) {
  const Location where{std::make_shared<const std::string>(request.file.string()), 0};
  const std::string bytes = read_bytes(request);
  const PlyHeader header = read_ply_header(bytes, where);
  MeshPart part;
  part.mesh = PlyReader(bytes, header, where, request).mesh(part.incomplete);
  MeshFile file;
  file.parts.push_back(std::move(part));
  return file;
}

} // namespace phlux::scene_file
