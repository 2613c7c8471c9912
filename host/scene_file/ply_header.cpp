#include "scene_file/ply_header.h"

#include <charconv>
#include <map>

#include "scene_file/values.h"

namespace phlux::scene_file {

namespace {

using Words = std::vector<std::string_view>;

PlyType read_type(std::string_view name, const Location& where) {
  static const std::map<std::string_view, PlyType> types{
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  const auto found = types.find(name);
  if (found == types.end())
    fail(where, quoted(name) + " is not a PLY type",
         "char, uchar, short, ushort, int, uint, float or double");
  return found->second;
}

bool is_integer(PlyType type) {
  return type != PlyType::float32 && type != PlyType::float64;
}

PlyHeader::Format read_format(const Words& words, const Location& where) {
  static const std::map<std::string_view, PlyHeader::Format> formats{
      {"ascii", PlyHeader::Format::ascii},
      {"binary_little_endian", PlyHeader::Format::little_endian},
      {"binary_big_endian", PlyHeader::Format::big_endian}};
  if (words.size() != 3 || !formats.contains(words[1]) || words[2] != "1.0")
    fail(where, "unknown PLY format", "format ascii, binary_little_endian or binary_big_endian, and 1.0");
  return formats.at(words[1]);
}

PlyElement read_element(const Words& words, const Location& where) {
  PlyElement element;
  bool valid = words.size() == 3;
  if (valid) {
    const char* end = words[2].data() + words[2].size();
    const auto [stopped, error] = std::from_chars(words[2].data(), end, element.rows);
    valid = error == std::errc{} && stopped == end;
  }
  if (!valid) fail(where, "malformed PLY element", "element NAME COUNT");
  element.name = words[1];
  element.line = where.line;
  return element;
}

PlyProperty read_property(const Words& words, const Location& where) {
  if (words.size() == 3) return {std::string(words[2]), read_type(words[1], where), std::nullopt};
  if (words.size() != 5 || words[1] != "list")
    fail(where, "malformed PLY property", "property TYPE NAME, or property list COUNT_TYPE TYPE NAME");
  PlyProperty list{std::string(words[4]), read_type(words[3], where), read_type(words[2], where)};
  if (!is_integer(*list.count_type)) fail(where, "a PLY list is counted by a real number", "an integer type");
  return list;
}

} // namespace

std::size_t byte_size(PlyType type) {
  switch (type) {
  case PlyType::int8:
  case PlyType::uint8:
    return 1;
  case PlyType::int16:
  case PlyType::uint16:
    return 2;
  case PlyType::int32:
  case PlyType::uint32:
  case PlyType::float32:
    return 4;
  case PlyType::float64:
    return 8;
  }
  return 0;
}

PlyHeader read_ply_header(std::string_view bytes, Location where) {
  PlyHeader header;
  bool has_format = false;
  while (true) {
    const auto end = bytes.find('\n', header.size);
    where.line = ++header.lines;
    if (end == std::string_view::npos) fail(where, "the PLY header has no end", "a line end_header");
    const auto line = bytes.substr(header.size, end - header.size);
    const auto words = split(line);
    header.size = end + 1;
    const auto keyword = words.empty() ? std::string_view() : words[0];
    if (header.lines == 1) {
      if (keyword != "ply") fail(where, "not a PLY file", "its first line must be ply");
    } else if (keyword == "format") {
      header.format = read_format(words, where);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(words, where));
    } else if (keyword == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(words, where));
    } else if (keyword == "end_header") {
      if (!has_format) fail(where, "the PLY header states no format", "a line format ascii 1.0 or the like");
      return header;
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      fail(where, "unexpected " + quoted(keyword) + " in the PLY header",
           "format, element, property, comment, end_header");
    }
  }
}

} // namespace phlux::scene_file
