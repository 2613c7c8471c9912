// Loads scenes from text for the tests of the scene file loader, with the log of loading.
#pragma once

#include <map>
#include <string>

#include "scene/scene.h"
#include "temporary_folder.h"

namespace phlux::test {

using Definitions = std::map<std::string, std::string>;

/// <scene version="VERSION"> on line 1, `body` from line 2 on.
std::string scene_text(const std::string& body, const std::string& version = "0.6.0");
/// The same with a sensor on line 1, which every scene needs.
std::string with_sensor(const std::string& body, const std::string& version = "0.6.0");

/// Texts by the names of their files; scene.xml is the scene.
using Files = std::map<std::string, std::string>;
scene::Scene load_files(const Files& files, const Definitions& definitions = {});
/// The SceneError of loading, without the name of the folder: "scene.xml:LINE: ..."; empty if there is none.
std::string error_of_files(const Files& files, const Definitions& definitions = {});
/// The log of loading, notes and warnings, one per line.
std::string log_of_files(const Files& files);

/// Loads text as the file scene.xml.
scene::Scene load_text(const std::string& text, const Definitions& definitions = {});
/// Loads with_sensor(body).
scene::Scene load_body(const std::string& body, const std::string& version = "0.6.0");

/// The SceneError of loading, without the name of the folder: "scene.xml:LINE: ..."; empty if there is none.
std::string error_of(const std::string& text, const Definitions& definitions = {});
/// The same for with_sensor(body).
std::string error_in(const std::string& body, const std::string& version = "0.6.0");

/// The log of loading, notes and warnings, one per line.
std::string log_of(const std::string& text);

/// A file name or message without the folder of the test.
std::string without_folder(std::string message, const TemporaryFolder& folder);

/// Loads <shape type="TYPE"> of a file with these bytes; `properties` go inside the shape.
scene::Mesh load_mesh(const std::string& type, const std::string& bytes, const std::string& properties = "");
/// The SceneError of load_mesh(), without the name of the folder.
std::string mesh_error(const std::string& type, const std::string& bytes);
std::string mesh_log(const std::string& type, const std::string& bytes);

} // namespace phlux::test
