// Process 0 renders with the help of the others, its workers. Each has one device.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cluster/group.h"
#include "render/processor.h"
#include "settings/choices.h"

namespace phlux::cluster {

/// The device of this process, "P:D": of those that `specifications` choose, each process of a machine takes
/// the next. @throws DeviceError as device::chosen_devices()
[[nodiscard]] std::string own_device(const Group& group, const std::vector<std::string>& specifications);

/// For process 0: the workers. They leave when the team ends, or at once if start() is never called.
class Team {
public:
  explicit Team(Group& group) : group_(group) {}
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Lets the workers load and build a scene. One whose scene has another digest is left out. Once
  /// `is_ending`, the work of one that does not answer is given up: mpirun, when a process has died, leaves
  /// the others a second.
  void start(const settings::Choices& choices, const std::string& scene_digest,
             std::function<bool()> is_ending);
  /// Valid as long as the team.
  [[nodiscard]] std::vector<render::Processor*> workers() const;

private:
  Group& group_;
  std::function<bool()> is_ending_;
  std::vector<std::unique_ptr<render::Processor>> workers_;
};

/// For workers: the choices of the render. Nothing if there is nothing to render.
[[nodiscard]] std::optional<settings::Choices> choices_of_render(Group& group);

/// For workers: waits until another process of the machine has built the kernels, which are in the cache
/// then. False if the render is over.
[[nodiscard]] bool wait_for_kernels(Group& group);

/// For workers: runs the launches that process 0 sends, until the render is over.
void serve(Group& group, render::Processor& device, const settings::Settings& settings,
           const std::string& scene_digest);

/// For workers: tells process 0 why this one cannot help.
void decline(Group& group, const std::string& why);

} // namespace phlux::cluster
