#include "cluster/group.h"

#include <array>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <malloc.h>
#include <sched.h>

#include "clock.h"
#include "errors.h"

#ifdef PHLUX_MPI
#include <mpi.h>
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

constexpr int message_tag = 0, life_tag = 1;

} // namespace

// Waiting inside MPI would keep a core busy: a thread looks for messages once in a millisecond.
struct Group::Connection {
  const int rank, size;
  std::mutex mpi; // calls of MPI: most transports allow one at a time
  std::mutex mutex;
  std::condition_variable arrived;
  std::vector<std::deque<Message>> inbox;   // by sender
  std::vector<Clock::time_point> last_sign; // of life, by sender
  std::jthread receiver;

  Connection(int own_rank, int processes)
      : rank(own_rank), size(processes), inbox(static_cast<std::size_t>(processes)),
        last_sign(static_cast<std::size_t>(processes), Clock::now()),
        receiver([this](const std::stop_token& stop) { run(stop); }) {}

  void run(const std::stop_token& stop) {
    using namespace std::chrono_literals;
    Clock::time_point next_sign = Clock::now();
    while (!stop.stop_requested()) {
      if (Clock::now() >= next_sign) {
        give_sign();
        next_sign = Clock::now() + 1s;
      }
      if (!receive_one()) std::this_thread::sleep_for(1ms);
    }
  }

  void give_sign() {
    const std::lock_guard lock(mpi);
    for (int other = 0; other < size; ++other)
      if (other != rank && (rank == 0 || other == 0)) {
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Isend(nullptr, 0, MPI_UINT64_T, other, life_tag, MPI_COMM_WORLD, &request);
        if (request != MPI_REQUEST_NULL) MPI_Request_free(&request);
      }
  }

  bool receive_one() {
    MPI_Status status;
    Message message;
    {
      const std::lock_guard lock(mpi);
      int is_there = 0;
      MPI_Message handle = MPI_MESSAGE_NULL;
      if (MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &handle, &status) !=
              MPI_SUCCESS ||
          is_there == 0)
        return false;
      int words = 0;
      MPI_Get_count(&status, MPI_UINT64_T, &words);
      message.size = static_cast<std::size_t>(words) * sizeof(std::uint64_t);
      message.bytes = std::make_shared_for_overwrite<std::byte[]>(message.size);
      if (MPI_Mrecv(message.bytes.get(), words, MPI_UINT64_T, &handle, &status) != MPI_SUCCESS) return false;
    }
    const std::lock_guard lock(mutex);
    const auto from = static_cast<std::size_t>(status.MPI_SOURCE);
    last_sign[from] = Clock::now();
    if (status.MPI_TAG == message_tag) inbox[from].push_back(std::move(message));
    arrived.notify_all();
    return true;
  }
};

Group::Group() {
  const Started start = started();
  if (start.processes == 1) return;
  int threads = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &threads);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  if (size_ != start.processes || threads < MPI_THREAD_SERIALIZED) {
    MPI_Finalize();
    throw UsageError(
        fmt::format("{} has started {} processes that {}: start them by the mpirun of the MPI that phlux was "
                    "built with, or by srun with its support for that MPI",
                    start.by, start.processes,
                    size_ != start.processes ? "do not reach each other" : "may not use threads with MPI"));
  }
  std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
  int length = 0;
  MPI_Get_processor_name(name.data(), &length);
  machine_.assign(name.data(), static_cast<std::size_t>(length));
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
  MPI_Comm_rank(machine, &local_rank_);
  MPI_Comm_size(machine, &local_size_);
  cores_ = gather_cores(machine, local_size_);
  MPI_Comm_free(&machine);
  if (size_ > 1) {
    // Messages of megabytes come and go; returning their memory to the system takes longer than to fill it.
    constexpr int kept = 1 << 30; // bytes
    ::mallopt(M_MMAP_THRESHOLD, kept);
    ::mallopt(M_TRIM_THRESHOLD, kept);
    connection_ = std::make_unique<Connection>(rank_, size_);
  }
}

Group::~Group() {
  if (size_ == 1) return;
  bool lost = false;
  for (int other = 0; other < size_; ++other) lost = lost || is_lost(other);
  connection_.reset();
  if (!lost) MPI_Finalize(); // which waits for the others
}

void Group::send(int to, const Message& message) {
  MPI_Request request = MPI_REQUEST_NULL;
  int is_done = 0;
  std::unique_lock lock(connection_->mpi);
  MPI_Isend(message.bytes.get(), static_cast<int>(message.size / sizeof(std::uint64_t)), MPI_UINT64_T, to,
            message_tag, MPI_COMM_WORLD, &request);
  while (MPI_Test(&request, &is_done, MPI_STATUS_IGNORE) == MPI_SUCCESS && is_done == 0) {
    lock.unlock();
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    lock.lock();
  }
}

std::optional<Message> Group::receive(int from, double most_seconds) {
  std::unique_lock lock(connection_->mutex);
  std::deque<Message>& inbox = connection_->inbox[static_cast<std::size_t>(from)];
  if (!connection_->arrived.wait_for(lock, std::chrono::duration<double>(most_seconds),
                                     [&] { return !inbox.empty(); }))
    return std::nullopt;
  Message message = std::move(inbox.front());
  inbox.pop_front();
  return message;
}

bool Group::is_lost(int rank) const {
  if (!connection_ || rank == rank_ || (rank_ != 0 && rank != 0)) return false;
  const std::lock_guard lock(connection_->mutex);
  return seconds_since(connection_->last_sign[static_cast<std::size_t>(rank)]) > patience_seconds;
}

#else

struct Group::Connection {};

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
