// The processes that mpirun or srun has started together, and their messages. The only part of phlux that
// knows MPI.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cluster/message.h"

namespace phlux::cluster {

/// The number of processes that were started together, from the environment variables of MPI and Slurm.
struct Started {
  int processes = 1, rank = 0;
  std::string by; ///< such as "mpirun"; empty if this process was started alone
};
[[nodiscard]] Started started();

class Connection;

/// Processes 0 to size() - 1; one alone, without MPI, unless started() says otherwise. There may be one
/// object in the life of a process.
class Group {
public:
  /// Joins the others, if any. @throws UsageError if there are others that cannot be reached
  Group();
  /// Waits for the others to leave too, except for lost ones.
  ~Group();
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  /// The number of this process among those on its machine.
  [[nodiscard]] int local_rank() const { return local_rank_; }
  [[nodiscard]] int local_size() const { return local_size_; }
  [[nodiscard]] const std::string& machine() const { return machine_; }

  /// Binds this process to its share of the cores that it and others of its machine may use, unless each has
  /// its own already. To be called before OpenCL's drivers start their threads.
  void divide_cores() const;

  /// From several threads. Returns at once. A message to a process that is lost is lost too.
  void send(int to, const Message& message);
  /// The oldest message from a process, for which it waits.
  [[nodiscard]] std::optional<Message> receive(int from, double most_seconds);
  /// Whether nothing has come from it for patience_seconds. Process 0 and the others send signs of life.
  [[nodiscard]] bool is_lost(int rank) const;
  static constexpr double patience_seconds = 30.0;

private:
  int rank_ = 0, size_ = 1, local_rank_ = 0, local_size_ = 1;
  std::string machine_;
  std::vector<std::vector<int>> cores_; ///< that each process of this machine may use
  std::unique_ptr<Connection> connection_;
};

/// Of processes that may use these cores: those for number `own`. Processes with the same cores divide them
/// evenly; if there are more processes than cores, each gets one.
[[nodiscard]] std::vector<int> share_of(const std::vector<std::vector<int>>& cores, std::size_t own);

} // namespace phlux::cluster
