// What the messages of a render contain.
#pragma once

#include <string>

#include "cluster/message.h"
#include "render/launch_result.h"
#include "settings/choices.h"

namespace phlux::cluster {

void add(const settings::Choices& choices, Packer& to);
[[nodiscard]] settings::Choices take_choices(Unpacker& from);

/// Of the records' arrays, only the parts in use.
void add(const render::LaunchResult& result, Packer& to);
/// Its batches are in the memory of the message.
[[nodiscard]] render::LaunchResult take_result(const Message& message, Unpacker& from);

/// A failure of a worker's device.
struct Failure {
  std::string text;
  bool memory_is_short = false, becomes_smaller = false, for_good = false;
};
void add(const Failure& failure, Packer& to);
[[nodiscard]] Failure take_failure(Unpacker& from);

} // namespace phlux::cluster
