#include "scene_file/scenes.h"

#include <sstream>

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include "errors.h"
#include "scene_file/load.h"

namespace phlux::test {

namespace {

/// Replaces the log during its lifetime.
class CapturedLog {
public:
  CapturedLog() : previous_(spdlog::default_logger()) {
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(text_);
    auto logger = std::make_shared<spdlog::logger>("captured", sink);
    logger->set_pattern("%l: %v");
    spdlog::set_default_logger(logger);
  }
  ~CapturedLog() { spdlog::set_default_logger(previous_); }
  CapturedLog(const CapturedLog&) = delete;
  CapturedLog& operator=(const CapturedLog&) = delete;
  [[nodiscard]] std::string text() const { return text_.str(); }

private:
  std::ostringstream text_;
  std::shared_ptr<spdlog::logger> previous_;
};

std::string mesh_scene(const std::string& type, const std::string& properties) {
  return with_sensor("<shape type=\"" + type + "\"><string name=\"filename\" value=\"mesh." + type + "\"/>" +
                     properties + "</shape>");
}

scene::Scene load_quietly(const std::filesystem::path& file, const Definitions& definitions = {}) {
  const CapturedLog quiet;
  return scene_file::load(file, definitions);
}

} // namespace

std::string without_folder(std::string message, const TemporaryFolder& folder) {
  const std::string prefix = folder.path().string() + "/";
  for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
    message.erase(at, prefix.size());
  return message;
}

std::string scene_text(const std::string& body, const std::string& version) {
  return "<scene version=\"" + version + "\">\n" + body + "\n</scene>\n";
}

std::string with_sensor(const std::string& body, const std::string& version) {
  return "<scene version=\"" + version + "\"><sensor type=\"perspective\"/>\n" + body + "\n</scene>\n";
}

scene::Scene load_text(const std::string& text, const Definitions& definitions) {
  const TemporaryFolder folder;
  folder.write("scene.xml", text);
  return load_quietly(folder / "scene.xml", definitions);
}

scene::Scene load_body(const std::string& body, const std::string& version) {
  return load_text(with_sensor(body, version));
}

std::string error_of(const std::string& text, const Definitions& definitions) {
  const TemporaryFolder folder;
  folder.write("scene.xml", text);
  try {
    static_cast<void>(load_quietly(folder / "scene.xml", definitions));
  } catch (const SceneError& error) {
    return without_folder(error.what(), folder);
  }
  return "";
}

std::string error_in(const std::string& body, const std::string& version) {
  return error_of(with_sensor(body, version));
}

std::string log_of(const std::string& text) {
  const TemporaryFolder folder;
  const CapturedLog log;
  folder.write("scene.xml", text);
  static_cast<void>(scene_file::load(folder / "scene.xml"));
  return without_folder(log.text(), folder);
}

scene::Mesh load_mesh(const std::string& type, const std::string& bytes, const std::string& properties) {
  const TemporaryFolder folder;
  folder.write("mesh." + type, bytes);
  folder.write("scene.xml", mesh_scene(type, properties));
  const auto scene = load_quietly(folder / "scene.xml");
  return scene.meshes.empty() ? scene::Mesh{} : scene.meshes.front();
}

std::string mesh_error(const std::string& type, const std::string& bytes) {
  const TemporaryFolder folder;
  folder.write("mesh." + type, bytes);
  folder.write("scene.xml", mesh_scene(type, ""));
  try {
    static_cast<void>(load_quietly(folder / "scene.xml"));
  } catch (const SceneError& error) {
    return without_folder(error.what(), folder);
  }
  return "";
}

std::string mesh_log(const std::string& type, const std::string& bytes) {
  const TemporaryFolder folder;
  folder.write("mesh." + type, bytes);
  folder.write("scene.xml", mesh_scene(type, ""));
  const CapturedLog log;
  static_cast<void>(scene_file::load(folder / "scene.xml"));
  return without_folder(log.text(), folder);
}

} // namespace phlux::test
