#include "bench/common/methods/build_ahead.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "errors.h"

namespace phlux::bench {
namespace {

constexpr int failed = 255;

[[noreturn]] void work(const std::vector<std::function<std::size_t()>>& jobs, std::size_t first,
                       std::size_t step) {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  std::size_t built = 0;
  try {
    for (std::size_t i = first; i < jobs.size(); i += step) built += jobs[i]();
  } catch (...) { // the parent process will get the same error
    ::_exit(failed);
  }
  ::_exit(static_cast<int>(std::min<std::size_t>(built, failed - 1)));
}

} // namespace

std::size_t run_in_children(const std::vector<std::function<std::size_t()>>& jobs) {
  const std::size_t count =
      std::min<std::size_t>(std::max(1u, std::thread::hardware_concurrency()), jobs.size());
  std::vector<pid_t> children;
  for (std::size_t i = 0; i < count; ++i) {
    const pid_t child = ::fork();
    if (child == 0) work(jobs, i, count);
    if (child > 0) children.push_back(child);
  }
  std::size_t built = 0;
  for (const pid_t child : children) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) != failed)
      built += static_cast<std::size_t>(WEXITSTATUS(status));
  }
  return built;
}

std::size_t build_programs(const std::vector<std::function<scene::Scene()>>& scenes,
                           const std::vector<Method>& methods, const SceneBenchSettings& settings) {
  std::vector<std::function<std::size_t()>> jobs;
  for (const auto& load : scenes)
    for (const Method& method : methods)
      jobs.emplace_back([&load, &method, &settings]() -> std::size_t {
        scene::Scene scene = load();
        scene.camera.width = scene.camera.height = 1;
        render::Settings one_sample = render_settings(method, scene, settings);
        one_sample.samples_per_pixel = 1;
        film::Film film(1, 1);
        try {
          return render::render(scene, one_sample, film, {}).kernels_from_cache ? 0 : 1;
        } catch (const Error&) {
          return 0;
        }
      });
  return run_in_children(jobs);
}

} // namespace phlux::bench
