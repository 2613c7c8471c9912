#include "device/program.h"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "clock.h"
#include "device/binary_cache.h"
#include "device/driver_cache.h"
#include "device/users_files.h"
#include "errors.h"

namespace phlux::device {

namespace {

constexpr std::chrono::milliseconds delay{200};

// Calls `slow` from another thread unless it is destroyed within `delay`.
class Watcher {
public:
  explicit Watcher(const std::function<void()>& slow) {
    if (!slow) return;
    try {
      thread_ = std::thread([this, slow] { wait(slow); });
    } catch (const std::system_error&) { // then `slow` is not called
    }
  }
  Watcher(const Watcher&) = delete;
  Watcher& operator=(const Watcher&) = delete;
  ~Watcher() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    changed_.notify_one();
    if (thread_.joinable()) thread_.join();
  }

private:
  void wait(const std::function<void()>& slow) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, delay, [this] { return done_; })) slow();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  std::thread thread_;
};

std::string cache_key(const Device& device, const std::string& text) {
  const cl::Platform platform(device.handle.getInfo<CL_DEVICE_PLATFORM>());
  return fmt::format("phlux {}, named arguments\n{}\n{}\n{}\n{}\n{}\n{}", PHLUX_VERSION, device.info.platform,
                     platform.getInfo<CL_PLATFORM_VERSION>(), device.info.name, device.info.driver,
                     build_options(), significant(text));
}

// The cache folder of a driver that caches programs itself, if it does. PoCL does; a query for a binary would
// make it compile every kernel a second time.
std::optional<std::filesystem::path> driver_cache(const Device& device) {
  if (device.info.platform != "Portable Computing Language") return std::nullopt;
  const char* folder = std::getenv("POCL_CACHE_DIR"); // device.cpp has set it
  const char* wanted = std::getenv("POCL_KERNEL_CACHE");
  if (folder == nullptr || *folder == '\0' || (wanted != nullptr && std::string(wanted) == "0"))
    return std::nullopt;
  return folder;
}

std::optional<cl::Program> build_binary(const Device& device, const std::vector<unsigned char>& binary) {
  try {
    cl::Program program(device.context, {device.handle}, {binary});
    program.build({device.handle}, build_options().c_str());
    return program;
  } catch (const cl::Error& error) {
    spdlog::debug("kernel cache: the driver refuses the binary: {}", describe(error));
    return std::nullopt;
  }
}

std::string build_log(const cl::Program& program, const cl::Device& device) {
  try {
    return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
  } catch (const cl::Error& error) {
    return fmt::format("(no log: {})", describe(error));
  }
}

// The compiler refuses the text; other DeviceErrors of a build are failures that say nothing about it.
struct Refused : DeviceError {
  Refused(const std::string& line, std::string of) : DeviceError(line), file(std::move(of)) {}
  std::string file; // of the first error; empty if it is not known
};

// Of "FILE:LINE: message".
std::size_t file_length(const std::string& error) {
  static const std::regex place(R"(:\d+: )");
  std::smatch found;
  return std::regex_search(error, found, place) ? static_cast<std::size_t>(found.position()) : 0;
}

cl::Program build_text(const Device& device, const std::string& name, const std::string& text) {
  cl::Program program;
  try {
    program = cl::Program(device.context, text);
    program.build({device.handle}, build_options().c_str());
    return program;
  } catch (const cl::Error& error) {
    const std::string log = program() == nullptr ? std::string() : build_log(program, device.handle);
    spdlog::debug("{} on {} ({}):\n{}", describe(error), device.info.name, device.info.driver, log);
    const std::string first = first_error(log, text);
    const std::string line =
        first.empty()
            ? fmt::format("{}: kernels do not build on {}: {}", name, device.info.name, describe(error))
            : fmt::format("{} (building kernels on {})", first, device.info.name);
    if (error.err() == CL_BUILD_PROGRAM_FAILURE) throw Refused(line, first.substr(0, file_length(first)));
    throw DeviceError(line);
  }
}

// Selects, in lanes.h, code without the processor's own instructions.
constexpr const char* portable_lanes_macro = "LANES_PORTABLE";

// The devices whose compiler rejects the builtins of those instructions.
class PortableDevices {
public:
  [[nodiscard]] bool has(const Device& device) const {
    const std::lock_guard lock(mutex_);
    return devices_.contains(device.handle());
  }
  void add(const Device& device) {
    const std::lock_guard lock(mutex_);
    devices_.insert(device.handle());
  }

private:
  mutable std::mutex mutex_;
  std::set<cl_device_id> devices_;
};

PortableDevices& portable_devices() {
  static PortableDevices devices;
  return devices;
}

// Empty when the driver returns no binary, which OpenCL allows.
std::vector<unsigned char> binary_of(const cl::Program& program) {
  try {
    const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
    return binaries.empty() ? std::vector<unsigned char>() : binaries.front();
  } catch (const cl::Error& error) {
    spdlog::debug("kernel cache: no binary: {}", describe(error));
    return {};
  }
}

// The name in a #line tag that `file`, from a compiler's message, refers to; empty if there is none. The
// message may have words before the name, or only the part of the name after its last blank.
std::string tagged_file(const std::string& text, const std::string& file) {
  static const std::regex tag(R"re((?:^|\n)#line \d+ "([^"\n]*)")re");
  for (std::sregex_iterator each(text.begin(), text.end(), tag), none; each != none; ++each) {
    const std::string name = (*each)[1];
    if (file == name || file.ends_with(" " + name) || name.ends_with(" " + file)) return name;
  }
  return {};
}

// The kernel file and line of a line of expanded text, by its #line tags, which oclgrind's messages ignore.
std::pair<std::string, int> place_in(const std::string& text, int wanted) {
  static const std::regex tag(R"re(#line (\d+) "(.*)")re");
  std::pair<std::string, int> place{"defines", 0};
  std::istringstream lines(text);
  std::smatch found;
  std::string line;
  for (int number = 1; number <= wanted && std::getline(lines, line); ++number) {
    if (std::regex_match(line, found, tag))
      place = {found[2], std::stoi(found[1]) - 1};
    else
      ++place.second;
  }
  return place;
}

} // namespace

std::string build_options() {
  std::string options = "-cl-std=CL1.2 -cl-denorms-are-zero -cl-kernel-arg-info";
  if (const char* more = std::getenv("PHLUX_KERNEL_OPTIONS"); more != nullptr && *more != '\0')
    options += fmt::format(" {}", more);
  return options;
}

std::string first_error(const std::string& log, const std::string& text) {
  // clang and most others: path.cl:12:3: error: ...; PoCL 3: error: path.cl:12:3: ...
  static const std::regex file_first(R"(([^\s:]+):(\d{1,9}):(?:\d+:)? *(?:fatal )?error: *([^\n]*))");
  static const std::regex error_first(R"(error: *([^\n:]+):(\d{1,9}):(?:\d+:)? *([^\n]*))");
  std::smatch found;
  if (!std::regex_search(log, found, file_first) && !std::regex_search(log, found, error_first)) return {};
  std::string file = found[1];
  int line = std::stoi(found[2]);
  if (const std::string tagged = tagged_file(text, file); !tagged.empty())
    file = tagged;
  else
    std::tie(file, line) = place_in(text, line);
  return fmt::format("{}:{}: {}", file, line, found.str(3));
}

namespace {

BuiltProgram build_expanded(const Device& device, const std::string& name, const std::string& text) {
  const std::string key = cache_key(device, text);
  if (const auto folder = driver_cache(device)) {
    const DriverCache cache(*folder, key);
    const auto program = build_text(device, name, text + cache.definition_of_mark());
    cache.built();
    return {program, cache.has_program(), 0, argument_names(program)};
  }
  const BinaryCache cache(binary_cache_folder());
  if (const auto bytes = cache.load(key)) { // with names, which a driver may not know for a binary
    NamedBinary kept = decode(*bytes);
    if (const auto program = build_binary(device, kept.binary))
      return {*program, true, 0, std::move(kept.arguments)};
  }
  const auto program = build_text(device, name, text);
  const NamedBinary built{argument_names(program), binary_of(program)};
  cache.store(key, encode(built));
  return {program, false, 0, built.arguments};
}

BuiltProgram build_portable(const Device& device, const sources::KernelFiles& files, ProgramSource source,
                            const std::string& name) {
  source.defines[portable_lanes_macro] = "1";
  return build_expanded(device, name, expand(files, source));
}

// Whether the first error may be in code for the processor's own instructions, which is in lanes/.
bool may_be_of_lanes(const std::string& error) {
  static const std::regex other_file(R"((?!lanes/).*:\d+: .*)");
  return !std::regex_match(error, other_file);
}

// Builds again with portable lanes where the compiler rejects the builtins of the processor's own
// instructions. If both builds fail, the error of the portable one is reported.
BuiltProgram build_either(const Device& device, const sources::KernelFiles& files,
                          const ProgramSource& source, const std::string& name) {
  const std::string text = expand(files, source);
  const bool compiler_decides = !source.defines.contains(portable_lanes_macro) &&
                                significant(text).find(portable_lanes_macro) != std::string::npos;
  if (!compiler_decides) return build_expanded(device, name, text);
  if (portable_lanes(device)) return build_portable(device, files, source, name);
  try {
    return build_expanded(device, name, text);
  } catch (const Refused& refusal) {
    if (!may_be_of_lanes(refusal.what())) throw;
    const BuiltProgram built = build_portable(device, files, source, name);
    portable_devices().add(device);
    spdlog::info(
        "portable lanes on {}, which are slower: its compiler refuses the intrinsics of the processor: {}",
        device.info.name, refusal.what());
    return built;
  }
}

} // namespace

bool portable_lanes(const Device& device) {
  return portable_devices().has(device);
}

BuiltProgram build(const Device& device, const sources::KernelFiles& files, const ProgramSource& source,
                   const std::function<void()>& slow) {
  const Clock::time_point start = Clock::now();
  const Watcher watcher(slow);
  try {
    BuiltProgram built = build_either(device, files, source, source.root.empty() ? "extra" : source.root);
    built.seconds = seconds_since(start);
    return built;
  } catch (const Refused& refusal) {
    if (is_users_file(source, refusal.file)) throw FileError(refusal.what());
    throw;
  }
}

} // namespace phlux::device
