// A small render that tests interrupt.
#pragma once

#include "checkpoint/checkpoint.h"
#include "scene/digest.h"
#include "scene_file/load.h"
#include "tested_kernels.h"

/// The Cornell box, with a number of pixels that no WIDTH divides.
[[nodiscard]] inline phlux::scene::Scene small_box() {
  return phlux::scene_file::load(PHLUX_SOURCE_DIR "/scenes/cornell-box.xml", {}, std::array{23, 17});
}

/// An interrupted or complete render.
struct Broken {
  phlux::checkpoint::Session session;
  phlux::film::Film film{23, 17};
};

/// Continues from `broken` until the film has received this many more launches; -1: to the end. Launches
/// still running then are lost.
inline void go_on(Broken& broken, int launches = -1) {
  using namespace phlux;
  std::optional<Broken> then;
  render::Events events;
  events.progress = [&](const render::Progress& progress) {
    if (launches-- != 0) return true;
    then = broken;
    then->session.state = progress.state();
    return false;
  };
  broken.session.settings.kernel_dir = test::tested_kernels();
  const render::Statistics statistics =
      render::render(small_box(), broken.session.settings, broken.film, events, broken.session.state);
  broken.session.state = statistics;
  if (then) broken = std::move(*then);
}
