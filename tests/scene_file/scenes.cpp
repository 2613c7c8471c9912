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

Files mesh_files(const std::string& type, const std::string& bytes, const std::string& properties = "") {
  return {{"mesh." + type, bytes},
          {"scene.xml", with_sensor("<shape type=\"" + type + "\"><string name=\"filename\" value=\"mesh." +
                                    type + "\"/>" + properties + "</shape>")}};
}

void write(const TemporaryFolder& folder, const Files& files) {
  for (const auto& [name, text] : files) folder.write(name, text);
}

} // namespace

scene::Scene load_files(const Files& files, const Definitions& definitions) {
  const TemporaryFolder folder;
  const CapturedLog quiet;
  write(folder, files);
  return scene_file::load(folder / "scene.xml", definitions);
}

std::string error_of_files(const Files& files, const Definitions& definitions) {
  const TemporaryFolder folder;
  const CapturedLog quiet;
  write(folder, files);
  try {
    static_cast<void>(scene_file::load(folder / "scene.xml", definitions));
  } catch (const SceneError& error) {
    return without_folder(error.what(), folder);
  }
  return "";
}

std::string log_of_files(const Files& files) {
  const TemporaryFolder folder;
  const CapturedLog log;
  write(folder, files);
  static_cast<void>(scene_file::load(folder / "scene.xml"));
  return without_folder(log.text(), folder);
}

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
  return load_files({{"scene.xml", text}}, definitions);
}

scene::Scene load_body(const std::string& body, const std::string& version) {
  return load_text(with_sensor(body, version));
}

std::string error_of(const std::string& text, const Definitions& definitions) {
  return error_of_files({{"scene.xml", text}}, definitions);
}

std::string error_in(const std::string& body, const std::string& version) {
  return error_of(with_sensor(body, version));
}

std::string log_of(const std::string& text) {
  return log_of_files({{"scene.xml", text}});
}

scene::Mesh load_mesh(const std::string& type, const std::string& bytes, const std::string& properties) {
  const auto scene = load_files(mesh_files(type, bytes, properties));
  return scene.meshes.empty() ? scene::Mesh{} : scene.meshes.front();
}

std::string mesh_error(const std::string& type, const std::string& bytes) {
  return error_of_files(mesh_files(type, bytes));
}

std::string mesh_log(const std::string& type, const std::string& bytes) {
  return log_of_files(mesh_files(type, bytes));
}

} // namespace phlux::test
