// A listener stands in for tev and takes its packets apart.
#include <cstring>
#include <thread>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "cli/workplace.h"

namespace {

class Listener {
public:
  Listener() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
    socklen_t size = sizeof address;
    REQUIRE(::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0);
    port = ntohs(address.sin_port);
  }
  ~Listener() { ::close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  // Takes one connection and all that it sends.
  void listen() {
    REQUIRE(::listen(socket_, 1) == 0);
    thread_ = std::jthread([this] {
      const int connection = ::accept(socket_, nullptr, nullptr);
      char buffer[4096];
      for (ssize_t count = 0; (count = ::read(connection, buffer, sizeof buffer)) > 0;)
        received_.append(buffer, static_cast<std::size_t>(count));
      ::close(connection);
    });
  }
  [[nodiscard]] const std::string& received() {
    thread_.join();
    return received_;
  }
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port); }

  int port = 0;

private:
  int socket_;
  std::string received_;
  std::jthread thread_;
};

// Reads the fields of a packet.
struct Fields {
  const std::string& bytes;
  std::size_t at = 0;

  template<class Value>
  Value get() {
    Value value{};
    REQUIRE(at + sizeof value <= bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof value);
    at += sizeof value;
    return value;
  }
  std::string text() {
    const std::string found = bytes.c_str() + at;
    at += found.size() + 1;
    return found;
  }
};

} // namespace

TEST_CASE("view sends every channel of an image to tev") {
  const Workplace place;
  REQUIRE(run({{"render", "scene.xml", "-n", "2", "-q"}, place.path(), {}, {}}).exit_code == 0);
  Listener tev;
  tev.listen();
  const Outcome outcome = run({{"view", "scene.exr", "--tev", tev.address()}, place.path(), {}, {}});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == "scene.exr: in tev at " + tev.address() + "\n");
  const std::string& received = tev.received();
  Fields create{received};
  CHECK(create.get<std::uint32_t>() == 4 + 1 + 1 + 10 + 4 + 4 + 4 + 2 + 2 + 2);
  CHECK(create.get<char>() == 4); // CreateImage
  CHECK(create.get<char>() == 1); // selected
  CHECK(create.text() == "scene.exr");
  CHECK(create.get<std::int32_t>() == 16);
  CHECK(create.get<std::int32_t>() == 12);
  CHECK(create.get<std::int32_t>() == 3);
  for (const char* channel : {"B", "G", "R"}) CHECK(create.text() == channel);
  Fields update{received, create.at};
  CHECK(update.get<std::uint32_t>() == received.size() - create.at); // one band
  CHECK(update.get<char>() == 5);                                    // UpdateImage of several channels
  CHECK(update.get<char>() == 0);
  CHECK(update.text() == "scene.exr");
  CHECK(update.get<std::int32_t>() == 3);
  for (int channel = 0; channel < 3; ++channel) update.text();
  for (const int value : {0, 0, 16, 12}) CHECK(update.get<std::int32_t>() == value);
  const phlux::files::Image image = place.image();
  for (const char* channel : {"B", "G", "R"})
    for (const float value : image.channels.at(channel)) CHECK(update.get<float>() == value);
  CHECK(update.at == received.size());
}

TEST_CASE("Without tev view says what to do, and writes a picture on request") {
  const Workplace place;
  REQUIRE(run({{"render", "scene.xml", "-n", "2", "-q"}, place.path(), {}, {}}).exit_code == 0);
  const Listener closed; // bound, so that no other process listens there
  const Outcome none = run({{"view", "scene.exr", "--tev", closed.address()}, place.path(), {}, {}});
  CHECK(none.exit_code == 5);
  CHECK(none.is_one_line_error());
  CHECK_THAT(none.err, Catch::Contains("no tev listens") && Catch::Contains("github.com/Tom94/tev") &&
                           Catch::Contains("--png scene.png"));
  const Outcome picture = run({{"view", "scene.exr", "--png", "look.png"}, place.path(), {}, {}});
  CHECK(picture.exit_code == 0);
  CHECK_THAT(picture.out, Catch::StartsWith("look.png: 16x12, --exposure "));
  CHECK(TemporaryFolder::read(place / "look.png") == TemporaryFolder::read(place / "scene.png"));
  CHECK(run({{"view", "scene.exr", "--tev", "nowhere"}, place.path(), {}, {}}).exit_code == 2);
}
