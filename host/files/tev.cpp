#include "files/tev.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include "errors.h"

namespace phlux::files {
namespace {

enum PacketType : std::uint8_t { create_image = 4, update_image = 5 }; // the latter with several channels

class Packet {
public:
  explicit Packet(PacketType type) {
    add(std::uint32_t{0}); // the length
    add(static_cast<std::uint8_t>(type));
    add(std::uint8_t{type == create_image}); // whether tev selects the image
  }
  void add(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
  void add(std::uint8_t byte) { bytes_ += static_cast<char>(byte); }
  void add(std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes_ += static_cast<char>(word >> shift);
  }
  void add(int number) { add(static_cast<std::uint32_t>(number)); }
  void add(float number) {
    std::uint32_t word = 0;
    std::memcpy(&word, &number, sizeof word);
    add(word);
  }
  [[nodiscard]] std::string finished() && {
    const auto length = static_cast<std::uint32_t>(bytes_.size());
    for (std::size_t i = 0; i < sizeof length; ++i) bytes_[i] = static_cast<char>(length >> (8 * i));
    return std::move(bytes_);
  }

private:
  std::string bytes_;
};

void add_channel_names(Packet& packet, const Image& image) {
  packet.add(static_cast<int>(image.channels.size()));
  for (const auto& [name, values] : image.channels) packet.add(name);
}

std::string created(const Image& image, const std::string& name) {
  Packet packet(create_image);
  packet.add(name);
  packet.add(image.width);
  packet.add(image.height);
  add_channel_names(packet, image);
  return std::move(packet).finished();
}

// Rows [first, first + rows).
std::string updated(const Image& image, const std::string& name, int first, int rows) {
  Packet packet(update_image);
  packet.add(name);
  add_channel_names(packet, image);
  for (const int number : {0, first, image.width, rows}) packet.add(number);
  for (const auto& [channel, values] : image.channels) {
    const auto begin = values.begin() + std::ptrdiff_t{first} * image.width;
    std::for_each(begin, begin + std::ptrdiff_t{rows} * image.width, [&](float value) { packet.add(value); });
  }
  return std::move(packet).finished();
}

struct CloseSocket {
  int descriptor = -1;
  ~CloseSocket() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

// -1 if nothing listens there.
int connected(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  const std::string host = address.substr(0, colon),
                    port = colon == std::string::npos ? "" : address.substr(colon + 1);
  const int failure =
      host.empty() || port.empty() ? EAI_NONAME : ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  if (failure != 0)
    throw UsageError(fmt::format("{}: {}: the address of tev is HOST:PORT, such as {}", address,
                                 ::gai_strerror(failure), tev_address));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, ::freeaddrinfo);
  for (const addrinfo* each = found; each != nullptr; each = each->ai_next) {
    const int descriptor = ::socket(each->ai_family, each->ai_socktype, each->ai_protocol);
    if (descriptor < 0) continue;
    if (::connect(descriptor, each->ai_addr, each->ai_addrlen) == 0) return descriptor;
    ::close(descriptor);
  }
  return -1;
}

} // namespace

std::string tev_packets(const Image& image, const std::string& name) {
  constexpr std::size_t values_per_band = 1U << 20;
  const std::size_t per_row =
      static_cast<std::size_t>(image.width) * std::max<std::size_t>(image.channels.size(), 1);
  const int rows = static_cast<int>(std::max<std::size_t>(values_per_band / per_row, 1));
  std::string packets = created(image, name);
  for (int row = 0; row < image.height; row += rows)
    packets += updated(image, name, row, std::min(rows, image.height - row));
  return packets;
}

bool show_in_tev(const Image& image, const std::string& name, const std::string& address) {
  const CloseSocket socket{connected(address)};
  if (socket.descriptor < 0) return false;
  const std::string packets = tev_packets(image, name);
  for (std::size_t sent = 0; sent < packets.size();) {
    const ssize_t count =
        ::send(socket.descriptor, packets.data() + sent, packets.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      throw WriteError(fmt::format("tev at {}: the connection broke: {}", address, std::strerror(errno)));
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

} // namespace phlux::files
