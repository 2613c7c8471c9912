#include "device/choice.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "errors.h"

namespace phlux::device {

namespace {

using Indices = std::vector<std::size_t>;

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::optional<std::pair<int, int>> parse_indices(const std::string& specification) {
  const auto colon = specification.find(':');
  const auto is_number = [](const std::string& text) {
    return !text.empty() && text.size() <= 6 &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  if (colon == std::string::npos) return std::nullopt;
  const std::string platform = specification.substr(0, colon), device = specification.substr(colon + 1);
  if (!is_number(platform) || !is_number(device)) return std::nullopt;
  return std::pair{std::stoi(platform), std::stoi(device)};
}

Indices those(const std::vector<DeviceInfo>& devices, const std::function<bool(const DeviceInfo&)>& meant) {
  Indices indices;
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (meant(devices[i])) indices.push_back(i);
  return indices;
}

Indices named(const std::string& part, const std::vector<DeviceInfo>& devices) {
  const auto contains = [&part](const std::string& name) {
    return lower_case(name).find(part) != std::string::npos;
  };
  if (part.empty()) return {};
  Indices by_platform = those(devices, [&](const DeviceInfo& each) { return contains(each.platform); });
  if (!by_platform.empty()) return by_platform;
  return those(devices, [&](const DeviceInfo& each) { return contains(each.name); });
}

std::string described(const DeviceInfo& info) {
  return fmt::format("{}:{} ({})", info.platform_index, info.device_index, info.platform);
}

bool same_cores(const DeviceInfo& a, const DeviceInfo& b) {
  return a.type == "cpu" && b.type == "cpu" && a.platform_index != b.platform_index;
}

// The first of `indices` that is the same CPU as devices[index] on another platform.
std::optional<std::size_t> same_cpu(const Indices& indices, std::size_t index,
                                    const std::vector<DeviceInfo>& devices) {
  const auto found =
      std::ranges::find_if(indices, [&](std::size_t i) { return same_cores(devices[i], devices[index]); });
  return found == indices.end() ? std::nullopt : std::optional(*found);
}

Indices once_per_core(const Indices& indices, const std::vector<DeviceInfo>& devices,
                      std::vector<std::string>& notes) {
  Indices kept;
  for (const std::size_t i : indices) {
    const auto other = same_cpu(kept, i, devices);
    if (other)
      notes.push_back(fmt::format("{} uses the same cores as {}: left out unless it is named as {}:{}",
                                  described(devices[i]), described(devices[*other]),
                                  devices[i].platform_index, devices[i].device_index));
    else
      kept.push_back(i);
  }
  return kept;
}

Indices matches(const std::string& specification, const std::vector<DeviceInfo>& devices,
                std::vector<std::string>& notes) {
  const std::string wanted = lower_case(specification);
  if (wanted == "all") return those(devices, [](const DeviceInfo&) { return true; });
  if (const auto indices = parse_indices(wanted))
    return those(devices, [&](const DeviceInfo& each) {
      return *indices == std::pair{each.platform_index, each.device_index};
    });
  if (wanted == "cpu" || wanted == "gpu")
    return once_per_core(those(devices, [&](const DeviceInfo& each) { return each.type == wanted; }), devices,
                         notes);
  return once_per_core(named(wanted, devices), devices, notes);
}

std::string listing(const std::vector<DeviceInfo>& devices) {
  std::string list;
  for (const DeviceInfo& info : devices)
    list += fmt::format("{}{}:{} ({}) {}, {}", list.empty() ? "" : "; ", info.platform_index,
                        info.device_index, info.type, info.name, info.platform);
  return list;
}

std::size_t default_device(const std::vector<DeviceInfo>& devices) {
  const auto cpu = std::ranges::find(devices, "cpu", &DeviceInfo::type);
  return cpu == devices.end() ? 0 : static_cast<std::size_t>(cpu - devices.begin());
}

} // namespace

Choice choose(const std::vector<std::string>& specifications, const std::vector<DeviceInfo>& devices) {
  Choice choice;
  for (const std::string& specification : specifications) {
    const Indices meant = matches(specification, devices, choice.notes);
    if (meant.empty())
      throw DeviceError(fmt::format("no OpenCL device '{}': there is {}", specification, listing(devices)));
    for (const std::size_t i : meant) {
      if (std::ranges::find(choice.devices, i) != choice.devices.end()) continue;
      if (const auto other = same_cpu(choice.devices, i, devices))
        choice.notes.push_back(fmt::format("{} and {} use the same cores: each slows the other",
                                           described(devices[*other]), described(devices[i])));
      choice.devices.push_back(i);
    }
  }
  if (choice.devices.empty()) choice.devices.push_back(default_device(devices));
  return choice;
}

} // namespace phlux::device
