// The elements of a scene file and of the files that it includes.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "scene_file/document.h"

namespace phlux::scene_file {

/// Whether <TAG> is an object, which has a type and may have an id.
[[nodiscard]] bool is_object_tag(const std::string& tag);

/// The <scene> of document.file with parameters substituted and <include>s replaced by what they include.
/// Unknown elements and attributes are left out and added to document.problems.
/// @throws SceneError for a file that cannot be read and for malformed XML
[[nodiscard]] Element read_elements(Document& document,
                                    const std::map<std::string, std::string>& definitions);

} // namespace phlux::scene_file
