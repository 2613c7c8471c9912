// A folder with a scene, used as working directory of the program.
#pragma once

#include "cli/program.h"
#include "cli/scenes.h"
#include "files/exr.h"

class Workplace : public TemporaryFolder {
public:
  Workplace() { write("scene.xml", good_scene); }

  [[nodiscard]] phlux::files::Image image(const std::string& name = "scene.exr") const {
    return phlux::files::read_exr(*this / name);
  }
};
