#include "device/driver_cache.h"

#include <chrono>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <random>
#include <regex>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "device/binary_cache.h"
#include "input_file.h"

namespace phlux::device {

namespace fs = std::filesystem;

namespace {

constexpr const char* access_time = "last_accessed"; // an empty file that PoCL touches

// Calls f(path) for each file of PoCL's folder of a program.
template<class Function>
void for_each_file(const fs::path& folder, const Function& f) {
  std::error_code error;
  for (fs::recursive_directory_iterator each(folder, error), none; !error && each != none;
       each.increment(error))
    if (std::error_code unknown; !each->is_directory(unknown) && each->path().filename() != access_time)
      f(each->path());
}

std::map<std::string, std::string> digests_in(const fs::path& folder) {
  std::map<std::string, std::string> digests;
  for_each_file(folder, [&](const fs::path& file) {
    const auto bytes = bytes_of(file);
    digests[file.lexically_relative(folder).string()] =
        bytes ? fmt::format("{} {}", bytes->size(), hash_of(*bytes)) : std::string();
  });
  return digests;
}

// Sizes of the files, which change when PoCL has compiled another kernel.
std::string sizes_in(const fs::path& folder) {
  std::map<std::string, std::uintmax_t> sizes;
  for_each_file(folder, [&](const fs::path& file) {
    std::error_code unknown;
    sizes[file.string()] = fs::file_size(file, unknown);
  });
  std::string text;
  for (const auto& [file, size] : sizes) text += fmt::format("{} {}\n", file, size);
  return text;
}

// PoCL's folder, XX/YYY, of the program with that mark, changed since `begin`; empty if there is none.
std::string folder_with(const std::string& mark, const fs::path& cache, fs::file_time_type begin) {
  std::error_code error, unknown;
  for (fs::directory_iterator group(cache, error), none; !error && group != none; group.increment(error)) {
    if (group->path().filename().string().size() != 2) continue;
    for (fs::directory_iterator each(*group, unknown); !unknown && each != none; each.increment(unknown)) {
      const fs::path program = each->path() / "program.bc";
      if (std::error_code missing; fs::last_write_time(program, missing) < begin || missing) continue;
      const auto bytes = bytes_of(program);
      if (bytes && bytes->find(mark) != std::string::npos)
        return each->path().lexically_relative(cache).string();
    }
  }
  return {};
}

// A program that this process has built.
struct Entry {
  fs::path cache;
  std::string mark;
  fs::file_time_type begin; // of building
  std::string folder;       // empty: not found yet
  std::string sizes;        // at the last record
};

// By key. Never destroyed, as it is used at the end of the process.
struct Entries {
  std::mutex mutex;
  std::map<std::string, Entry> by_key;
};
Entries& entries() {
  static Entries& all = *new Entries;
  return all;
}

void record(const std::string& key, Entry& entry) {
  if (entry.folder.empty()) entry.folder = folder_with(entry.mark, entry.cache, entry.begin);
  if (entry.folder.empty()) return;
  const std::string sizes = sizes_in(entry.cache / entry.folder);
  if (sizes == entry.sizes) return;
  const std::string text =
      DriverRecord{entry.mark, entry.folder, digests_in(entry.cache / entry.folder)}.encode();
  BinaryCache(entry.cache / "phlux").store(key, {text.begin(), text.end()});
  entry.sizes = sizes;
}

std::string new_mark() {
  std::random_device random;
  return fmt::format("phlux_{:08x}{:08x}", random(), random());
}

} // namespace

std::string DriverRecord::encode() const {
  std::string text = fmt::format("{}\n{}\n", mark, folder);
  for (const auto& [file, digest] : digests) text += fmt::format("{} {}\n", digest, file);
  return text;
}

std::optional<DriverRecord> DriverRecord::decode(const std::string& text) {
  static const std::regex mark("phlux_[0-9a-f]{16}"), folder("[A-Za-z0-9]{2}/[A-Za-z0-9]{8,64}");
  DriverRecord record;
  std::istringstream lines(text);
  std::getline(lines, record.mark);
  std::getline(lines, record.folder);
  if (record.mark.size() > 64 || !std::regex_match(record.mark, mark) || record.folder.size() > 80 ||
      !std::regex_match(record.folder, folder))
    return std::nullopt;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t blank = line.find(' '), second = line.find(' ', blank + 1);
    if (blank == std::string::npos || second == std::string::npos) return std::nullopt;
    record.digests[line.substr(second + 1)] = line.substr(0, second);
  }
  return record;
}

DriverCache::DriverCache(fs::path folder, std::string key)
    : folder_(std::move(folder)), key_(std::move(key)), mark_(new_mark()),
      begin_(fs::file_time_type::clock::now() - std::chrono::minutes(1)) { // clocks of file systems differ
  {
    const std::lock_guard lock(entries().mutex);
    if (const auto found = entries().by_key.find(key_); found != entries().by_key.end()) {
      mark_ = found->second.mark;
      has_program_ = true;
      return;
    }
  }
  const auto bytes = BinaryCache(folder_ / "phlux").load(key_);
  const auto record = bytes ? DriverRecord::decode({bytes->begin(), bytes->end()}) : std::nullopt;
  if (!record) return;
  if (!record->digests.empty() && digests_in(folder_ / record->folder) == record->digests) {
    mark_ = record->mark;
    program_folder_ = record->folder;
    has_program_ = true;
    return;
  }
  spdlog::info("kernel cache: {} differs from what was recorded: built anew",
               (folder_ / record->folder).string());
  std::error_code ignored;
  fs::remove_all(folder_ / record->folder, ignored);
}

std::string DriverCache::definition_of_mark() const {
  return fmt::format("\n__constant int {} = 0;\n", mark_);
}

void DriverCache::built() const {
  static std::once_flag once;
  std::call_once(once, [] { std::atexit(record_driver_cache); });
  const std::lock_guard lock(entries().mutex);
  const auto [entry, added] =
      entries().by_key.try_emplace(key_, Entry{folder_, mark_, begin_, program_folder_, {}});
  if (added) record(key_, entry->second);
}

void record_driver_cache() {
  const std::lock_guard lock(entries().mutex);
  try {
    for (auto& [key, entry] : entries().by_key) record(key, entry);
  } catch (const std::exception& error) {
    spdlog::debug("kernel cache: no record: {}", error.what());
  }
}

} // namespace phlux::device
