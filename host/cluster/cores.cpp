#include <algorithm>
#include <cstdlib>
#include <string>

#include <sched.h>

#include "cluster/group.h"

namespace phlux::cluster {

std::vector<int> share_of(const std::vector<std::vector<int>>& cores, std::size_t own) {
  const std::vector<int>& all = cores[own];
  std::size_t same = 0, before = 0; // processes
  for (std::size_t i = 0; i < cores.size(); ++i) {
    if (cores[i] != all) continue;
    ++same;
    if (i < own) ++before;
  }
  const std::size_t begin = before * all.size() / same, end = (before + 1) * all.size() / same;
  const auto at = [&](std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
  if (begin < end) return {at(begin), at(end)};
  return {at(begin), at(begin + 1)};
}

void Group::divide_cores() const {
  if (local_size_ < 2) return;
  const std::vector<int> own = share_of(cores_, static_cast<std::size_t>(local_rank_));
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int core : own) CPU_SET(static_cast<std::size_t>(core), &set);
  static_cast<void>(::sched_setaffinity(0, sizeof set, &set)); // else the system divides them
  // PoCL counts the machine's cores.
  const std::string count = std::to_string(own.size());
  for (const char* const name : {"POCL_MAX_PTHREAD_COUNT", "POCL_CPU_MAX_CU_COUNT"})
    ::setenv(name, count.c_str(), 0);
}

} // namespace phlux::cluster
