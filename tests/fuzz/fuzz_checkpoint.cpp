// Checkpoints with the right digest: a state of the render that resumes, or an Error. The input is a file
// without its first line.
#include "checkpoint/first_line.h"
#include "checkpoint/sameness.h"
#include "errors.h"
#include "film/reliability.h"
#include "input.h"

using namespace phlux;

namespace {

checkpoint::Session session_of(const settings::Settings& settings) {
  return {.scene = "box.xml", .scene_digest = "1234", .choices = {}, .settings = settings, .state = {}};
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  const Input input(test::with_first_line({reinterpret_cast<const char*>(bytes), count}));
  try {
    checkpoint::Checkpoint earlier = checkpoint::read(input.file());
    earlier.session.scene_digest = "1234";
    settings::Settings settings = earlier.session.settings;
    settings.time_limit = 1;
    checkpoint::check_same(earlier, session_of(settings), earlier.film.width(), earlier.film.height(), "c");
    const std::size_t pixels = earlier.film.pixels().size();
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) earlier.film.add(pixel, {{1, 2, 3}, {1, 4, 9}}, 16);
    if (earlier.film.splats()) earlier.film.add_splat(pixels - 1, {1, 2, 3});
    static_cast<void>(film::reliability_of(earlier.film));
    render::Schedule schedule(static_cast<std::int64_t>(pixels), std::nullopt,
                              earlier.session.state.position);
    for (int i = 0; i < 100; ++i)
      static_cast<void>(schedule.next([](std::int64_t left, int) { return left; }));
  } catch (const Error&) {
  }
  return 0;
}
