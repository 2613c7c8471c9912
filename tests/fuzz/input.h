// The bytes of a fuzzer as a file, for readers that take a name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

/// A file in memory that holds these bytes; it ends with the object.
class Input {
public:
  Input(const std::uint8_t* bytes, std::size_t count)
      : Input(std::string(reinterpret_cast<const char*>(bytes), count)) {}
  explicit Input(const std::string& bytes) : descriptor_(::memfd_create("input", MFD_CLOEXEC)) {
    if (descriptor_ < 0 ||
        ::write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
      std::abort();
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  ~Input() { ::close(descriptor_); }
  [[nodiscard]] std::filesystem::path file() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
  int descriptor_;
};
