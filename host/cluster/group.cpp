#include "cluster/group.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <future>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <malloc.h>
#include <sched.h>

#include "errors.h"

#ifdef PHLUX_MPI
#include "cluster/connection.h"
#endif

namespace phlux::cluster {
namespace {

int number_in_environment(const char* name) {
  const char* const text = std::getenv(name);
  int number = -1;
  if (text != nullptr) std::from_chars(text, text + std::strlen(text), number);
  return number;
}

} // namespace

Started started() {
  struct Launcher {
    const char *by, *processes, *rank;
  };
  constexpr std::array launchers = {
      Launcher{"mpirun", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, // Open MPI
      Launcher{"mpirun", "PMI_SIZE", "PMI_RANK"},                         // MPICH and its kin
      Launcher{"srun", "SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};
  for (const auto& [by, processes, rank] : launchers)
    if (const int count = number_in_environment(processes); count > 0)
      return {count, std::max(number_in_environment(rank), 0), by};
  return {};
}

#ifdef PHLUX_MPI

namespace {

// The cores that each process of a machine may use.
std::vector<std::vector<int>> gather_cores(MPI_Comm machine, int processes) {
  cpu_set_t own;
  CPU_ZERO(&own);
  ::sched_getaffinity(0, sizeof own, &own);
  std::vector<cpu_set_t> sets(static_cast<std::size_t>(processes));
  MPI_Allgather(&own, sizeof own, MPI_BYTE, sets.data(), sizeof own, MPI_BYTE, machine);
  std::vector<std::vector<int>> cores(sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (int core = 0; core < CPU_SETSIZE; ++core)
      if (CPU_ISSET(static_cast<std::size_t>(core), &sets[i])) cores[i].push_back(core);
  return cores;
}

// Whether MPI returns in time: calls that wait for other processes never do once one of these is lost.
bool return_within(double seconds, const std::function<void()>& calls) {
  auto is_done = std::make_shared<std::promise<void>>();
  const std::future<void> done = is_done->get_future();
  std::thread([is_done = std::move(is_done), calls] {
    calls();
    is_done->set_value();
  }).detach();
  return done.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
}

// What a process knows once it has joined the others.
struct Membership {
  int rank = 0, size = 1, local_rank = 0, local_size = 1;
  std::string machine;
  std::vector<std::vector<int>> cores; // that each process of this machine may use
  bool may_use_threads = false;
};

Membership join() {
  Membership own;
  int threads = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &threads);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, &own.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &own.size);
  own.may_use_threads = threads >= MPI_THREAD_SERIALIZED;
  std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
  int length = 0;
  MPI_Get_processor_name(name.data(), &length);
  own.machine.assign(name.data(), static_cast<std::size_t>(length));
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, own.rank, MPI_INFO_NULL, &machine);
  MPI_Comm_rank(machine, &own.local_rank);
  MPI_Comm_size(machine, &own.local_size);
  own.cores = gather_cores(machine, own.local_size);
  MPI_Comm_free(&machine);
  return own;
}

} // namespace

Group::Group() {
  const Started start = started();
  if (start.processes == 1) return;
  constexpr double most_seconds = 120.0; // between the starts of the first process and the last
  const auto own = std::make_shared<Membership>();
  if (!return_within(most_seconds, [own] { *own = join(); }))
    throw UsageError(fmt::format("{} has started {} processes, not all of which have joined within {} s",
                                 start.by, start.processes, most_seconds));
  if (own->size != start.processes || !own->may_use_threads) {
    return_within(patience_seconds, [] { MPI_Finalize(); });
    throw UsageError(
        fmt::format("{} has started {} processes that {}: start them by the mpirun of the MPI that phlux was "
                    "built with, or by srun with its support for that MPI",
                    start.by, start.processes,
                    own->may_use_threads ? "do not reach each other" : "may not use threads with MPI"));
  }
  rank_ = own->rank;
  size_ = own->size;
  local_rank_ = own->local_rank;
  local_size_ = own->local_size;
  machine_ = std::move(own->machine);
  cores_ = std::move(own->cores);
  // Messages of megabytes come and go; returning their memory to the system takes longer than to fill it.
  constexpr int kept = 1 << 30; // bytes
  ::mallopt(M_MMAP_THRESHOLD, kept);
  ::mallopt(M_TRIM_THRESHOLD, kept);
  connection_ = std::make_unique<Connection>(rank_, size_, patience_seconds);
}

Group::~Group() {
  if (size_ == 1) return;
  if (connection_->leave())
    return_within(patience_seconds, [] { MPI_Finalize(); }); // one may be lost since it has left
  else
    static_cast<void>(connection_.release()); // MPI still knows the memory of messages to lost processes
}

void Group::send(int to, const Message& message) {
  connection_->send(to, message);
}

std::optional<Message> Group::receive(int from, double most_seconds) {
  return connection_->receive(from, most_seconds);
}

bool Group::is_lost(int rank) const {
  if (!connection_ || rank == rank_ || (rank_ != 0 && rank != 0)) return false;
  return connection_->is_lost(rank);
}

#else

class Connection {};

Group::Group() {
  if (const Started start = started(); start.processes > 1)
    throw UsageError(fmt::format("{} has started {} processes, and this phlux was built without MPI: install "
                                 "libopenmpi-dev and build it anew, or start one process",
                                 start.by, start.processes));
}
Group::~Group() = default;
void Group::send(int, const Message&) {}
std::optional<Message> Group::receive(int, double) {
  return std::nullopt;
}
bool Group::is_lost(int) const {
  return false;
}

#endif

} // namespace phlux::cluster
