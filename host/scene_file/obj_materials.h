// The material library of an OBJ file.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "scene/scene.h"
#include "scene_file/warnings.h"

namespace phlux::scene_file {

/// The materials of a .mtl file by name, by Mitsuba 0.6's rules: Kd and Ks are sRGB; a phong of exponent Ns
/// for illum 2, a diffuse otherwise. Maps and other models of illumination are replaced by the diffuse, with
/// a warning. A file that cannot be read gives none, with a warning.
/// @throws SceneError "FILE:LINE: ..." for numbers that cannot be read
[[nodiscard]] std::map<std::string, scene::Material>
read_obj_materials(const std::filesystem::path& file, const Location& named_at, Warnings& warnings);

} // namespace phlux::scene_file
