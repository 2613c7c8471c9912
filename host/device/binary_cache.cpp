#include "device/binary_cache.h"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "device/cache_folder.h"

namespace phlux::device {

namespace fs = std::filesystem;

namespace {

constexpr const char* suffix = ".clbin";
constexpr std::size_t hash_digits = 32;

void warn_once(const std::string& line) {
  static std::once_flag once;
  std::call_once(once, [&] { spdlog::warn("{}", line); });
}

} // namespace

std::string hash_of(const std::string& bytes) {
  __extension__ using Hash = unsigned __int128;
  constexpr auto prime = (Hash{1} << 88) + 0x13b;
  auto hash = (Hash{0x6c62272e07bb0142} << 64) + 0x62b821756295c58d;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= prime;
  }
  return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(hash >> 64),
                     static_cast<std::uint64_t>(hash));
}

fs::path binary_cache_folder() {
  if (const char* given = std::getenv("PHLUX_CACHE_DIR"); given != nullptr && *given != '\0') return given;
  if (auto user = user_cache_folder("phlux")) return *user;
  return temporary_cache_folder("kernels").value_or(fs::path());
}

BinaryCache::BinaryCache(fs::path folder) : folder_(std::move(folder)) {
  if (!folder_.empty() && writable_folder(folder_)) return;
  warn_once(
      fmt::format("the kernel cache {} is not writable: kernels are built anew each time (PHLUX_CACHE_DIR "
                  "names another folder)",
                  folder_.string()));
  folder_.clear();
}

fs::path BinaryCache::file_of(const std::string& key) const {
  return folder_ / (hash_of(key) + suffix);
}

// A file is the hash of the binary, then the binary.
std::optional<std::vector<unsigned char>> BinaryCache::load(const std::string& key) const {
  if (folder_.empty()) return std::nullopt;
  std::ifstream stream(file_of(key), std::ios::binary);
  if (!stream) return std::nullopt;
  const std::string content(std::istreambuf_iterator<char>(stream), {});
  if (content.size() <= hash_digits) return std::nullopt;
  const std::string binary = content.substr(hash_digits);
  if (hash_of(binary) != content.substr(0, hash_digits)) {
    spdlog::debug("kernel cache: {} is damaged", file_of(key).string());
    return std::nullopt;
  }
  return std::vector<unsigned char>(binary.begin(), binary.end());
}

void BinaryCache::store(const std::string& key, const std::vector<unsigned char>& binary) const {
  if (folder_.empty() || binary.empty()) return;
  static std::atomic<unsigned> counter = 0;
  const fs::path file = file_of(key);
  fs::path unfinished = file;
  unfinished += fmt::format(".{}-{}", getpid(), counter++);

  const std::string bytes(binary.begin(), binary.end());
  std::ofstream stream(unfinished, std::ios::binary);
  stream << hash_of(bytes) << bytes;
  stream.close();
  std::error_code failed;
  if (stream) fs::rename(unfinished, file, failed);
  if (!stream || failed) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    warn_once(fmt::format("{}: kernels could not be kept for the next start", file.string()));
  }
}

} // namespace phlux::device
