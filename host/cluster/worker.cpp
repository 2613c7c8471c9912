#include "cluster/team.h"
#include "cluster/transfer.h"
#include "render/dispatch.h"

namespace phlux::cluster {
namespace {

constexpr double moment = 0.1; // seconds

// The next message of process 0; the end if that is lost.
Message wait_for_message(Group& group) {
  while (true) {
    if (auto message = group.receive(0, moment)) return std::move(*message);
    if (group.is_lost(0)) return packed(Kind::end);
  }
}

class Service {
public:
  Service(Group& group, render::Processor& device, const settings::Settings& settings)
      : group_(group), device_(device), settings_(settings) {}

  // Until the render is over.
  void run() {
    while (true) {
      while (std::optional<Message> message = next_message())
        if (!handle(*message)) return;
      if (device_.in_flight() > 0) attempt([&] { finish_launch(); });
    }
  }

private:
  std::optional<Message> next_message() {
    if (device_.in_flight() == 0) return wait_for_message(group_);
    return group_.receive(0, 0.0);
  }

  // False at the end.
  bool handle(const Message& message) {
    Unpacker from(message);
    const auto kind = from.take<Kind>();
    if (kind == Kind::end) return false;
    if (kind == Kind::begin) attempt([&] { device_.begin(settings_); });
    if (kind == Kind::abandon) {
      device_.abandon();
      generation_ = from.take<std::uint64_t>();
    }
    // After a failure, launches that are on their way are dropped until process 0 has abandoned them.
    if (kind == Kind::launch && from.take<std::uint64_t>() == generation_)
      attempt([&] { device_.enqueue(from.take<render::Launch>()); });
    return true;
  }

  void finish_launch() {
    device_.settle();
    if (!settings_.techniques) merge(device_.result());
    group_.send(0, packed(Kind::result, [&](Packer& to) {
                  to.add(generation_);
                  to.add(device_.pace());
                  add(device_.result(), to);
                }));
    device_.release();
  }

  // Process 0, which alone adds results to the film, has less to do then.
  void merge(render::LaunchResult& result) {
    for (const film::SplatRecords& batch : result.batches) splats_.merge(batch);
    result.merged = true;
  }

  template<class Step>
  void attempt(const Step& step) {
    try {
      step();
    } catch (...) {
      const std::optional<render::Failure> failure = render::current_failure();
      if (!failure) throw;
      device_.abandon();
      const bool smaller = failure->memory_is_short && device_.shrink();
      group_.send(0, packed(Kind::failure, [&](Packer& to) {
                    to.add(generation_);
                    add(Failure{device_.name() + ": " + failure->text, failure->memory_is_short, smaller,
                                failure->for_good},
                        to);
                  }));
      ++generation_; // as process 0 will
    }
  }

  Group& group_;
  render::Processor& device_;
  const settings::Settings& settings_;
  std::uint64_t generation_ = 0;
  film::SplatFolder splats_;
};

} // namespace

std::optional<settings::Choices> choices_of_render(Group& group) {
  const Message message = wait_for_message(group);
  Unpacker from(message);
  if (from.take<Kind>() != Kind::choices) return std::nullopt;
  return take_choices(from);
}

bool wait_for_kernels(Group& group) {
  if (group.local_rank() == 0) return true;
  const Message message = wait_for_message(group);
  return Unpacker(message).take<Kind>() != Kind::end;
}

void serve(Group& group, render::Processor& device, const settings::Settings& settings,
           const std::string& scene_digest) {
  device.begin(settings);
  group.send(0, packed(Kind::ready, [&](Packer& to) {
               to.add(device.pace());
               to.add(group.machine());
               to.add(scene_digest);
             }));
  Service(group, device, settings).run();
}

void decline(Group& group, const std::string& why) {
  group.send(0, packed(Kind::failure, [&](Packer& to) {
               to.add(std::uint64_t{0});
               add(Failure{group.machine() + ": " + why, false, false, true}, to);
             }));
  while (true) {
    const Message message = wait_for_message(group);
    if (Unpacker(message).take<Kind>() == Kind::end) return;
  }
}

} // namespace phlux::cluster
