#include "cluster/team.h"

#include <deque>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cluster/transfer.h"
#include "device/device.h"

namespace phlux::cluster {
namespace {

using render::LaunchResult;

// A worker, as process 0 sees it. The generation of a launch tells whether it was abandoned.
class Worker final : public render::Processor {
public:
  Worker(Group& group, int rank, std::string scene_digest, const std::function<bool()>& is_ending)
      : group_(group), rank_(rank), scene_digest_(std::move(scene_digest)), is_ending_(is_ending),
        name_(fmt::format("process {}", rank)) {}

  void begin(const settings::Settings&) override { group_.send(rank_, packed(Kind::begin)); }

  bool is_ready() override {
    constexpr double moment = 0.05; // seconds
    if (!ready_) handle(group_.receive(rank_, moment));
    return ready_;
  }
  [[nodiscard]] render::Pace pace() const override { return pace_; }

  void enqueue(const render::Launch& launch) override {
    group_.send(rank_, packed(Kind::launch, [&](Packer& to) {
                  to.add(generation_);
                  to.add(launch);
                }));
    ++in_flight_;
  }
  [[nodiscard]] std::size_t in_flight() const override { return in_flight_; }
  // One runs, one waits for the device, and one is on its way.
  [[nodiscard]] std::size_t most_in_flight() const override { return 3; }

  void settle() override {
    constexpr double patience = 0.25; // seconds
    while (results_.empty()) {
      const bool was_ending = is_ending_();
      const std::optional<Message> message = group_.receive(rank_, patience);
      if (!message && was_ending) lose("no answer while the render ends");
      handle(message);
    }
  }
  [[nodiscard]] LaunchResult& result() override { return results_.front(); }
  void release() noexcept override {
    results_.pop_front();
    --in_flight_;
  }
  [[nodiscard]] LaunchResult detach() override {
    LaunchResult result = std::move(results_.front());
    release();
    return result;
  }

  void abandon() noexcept override {
    ++generation_;
    in_flight_ = 0;
    results_.clear();
    group_.send(rank_, packed(Kind::abandon, [&](Packer& to) { to.add(generation_); }));
  }
  [[nodiscard]] bool shrink() override { return became_smaller_; }
  [[nodiscard]] std::string name() const override { return name_; }

private:
  void handle(const std::optional<Message>& message) {
    if (!message) {
      if (!lost_.empty()) throw render::ProcessorLost(lost_);
      if (group_.is_lost(rank_)) lose(fmt::format("no message from it for {} s", Group::patience_seconds));
      return;
    }
    Unpacker from(*message);
    switch (from.take<Kind>()) {
    case Kind::ready:
      return note_ready(from);
    case Kind::result:
      return note_result(*message, from);
    case Kind::failure:
      return note_failure(from);
    default:
      return;
    }
  }

  [[noreturn]] void lose(const std::string& why) {
    lost_ = why;
    throw render::ProcessorLost(why);
  }

  void note_ready(Unpacker& from) {
    pace_ = from.take<render::Pace>();
    name_ = fmt::format("process {}, {}", rank_, from.take_text());
    if (from.take_text() != scene_digest_) lose("it reads another scene: all processes need the same files");
    ready_ = true;
  }

  void note_result(const Message& message, Unpacker& from) {
    if (from.take<std::uint64_t>() != generation_) return;
    pace_ = from.take<render::Pace>();
    results_.push_back(take_result(message, from));
  }

  void note_failure(Unpacker& from) {
    const auto generation = from.take<std::uint64_t>();
    const auto failure = take_failure(from);
    if (failure.for_good) lose(failure.text);
    if (generation != generation_) return;
    became_smaller_ = failure.becomes_smaller;
    if (failure.memory_is_short) throw render::MemoryShort(failure.text);
    throw DeviceError(failure.text);
  }

  Group& group_;
  int rank_;
  std::string scene_digest_;
  const std::function<bool()>& is_ending_;
  std::string name_, lost_; // why it is lost
  bool ready_ = false, became_smaller_ = false;
  render::Pace pace_;
  std::uint64_t generation_ = 0;
  std::size_t in_flight_ = 0;
  std::deque<LaunchResult> results_;
};

} // namespace

std::string own_device(const Group& group, const std::vector<std::string>& specifications) {
  const std::vector<device::DeviceInfo> devices = device::chosen_devices(specifications);
  const device::DeviceInfo& own = devices[static_cast<std::size_t>(group.local_rank()) % devices.size()];
  return fmt::format("{}:{}", own.platform_index, own.device_index);
}

Team::~Team() {
  for (int rank = 1; rank < group_.size(); ++rank) group_.send(rank, packed(Kind::end));
}

void Team::start(const settings::Choices& choices, const std::string& scene_digest,
                 std::function<bool()> is_ending) {
  is_ending_ = std::move(is_ending);
  for (int rank = 1; rank < group_.size(); ++rank) {
    group_.send(rank, packed(Kind::choices, [&](Packer& to) { add(choices, to); }));
    workers_.push_back(std::make_unique<Worker>(group_, rank, scene_digest, is_ending_));
  }
}

std::vector<render::Processor*> Team::workers() const {
  std::vector<render::Processor*> all;
  for (const auto& worker : workers_) all.push_back(worker.get());
  return all;
}

} // namespace phlux::cluster
