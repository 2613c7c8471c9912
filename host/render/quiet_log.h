// Silence for renders that the user did not ask for one by one.
#pragma once

#include <algorithm>

#include <spdlog/spdlog.h>

namespace phlux::render {

/// While one lives, warnings are not shown: each render would repeat them.
class QuietLog {
public:
  QuietLog() : level_(spdlog::get_level()) { spdlog::set_level(std::max(level_, spdlog::level::err)); }
  ~QuietLog() { spdlog::set_level(level_); }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;

private:
  spdlog::level::level_enum level_;
};

} // namespace phlux::render
