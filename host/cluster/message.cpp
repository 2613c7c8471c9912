#include "cluster/message.h"

namespace phlux::cluster {

Message packed(Kind kind, const std::function<void(Packer&)>& write) {
  const auto write_to = [&](std::byte* to) {
    Packer packer(to);
    packer.add(kind);
    if (write) write(packer);
    return packer.size();
  };
  Message message;
  message.size = write_to(nullptr);
  message.bytes = std::make_shared_for_overwrite<std::byte[]>(message.size);
  write_to(message.bytes.get());
  return message;
}

} // namespace phlux::cluster
