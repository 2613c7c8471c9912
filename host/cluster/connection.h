// Messages between processes by MPI, none of which waits for a process that is lost.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include <mpi.h>

#include "clock.h"
#include "cluster/message.h"

namespace phlux::cluster {

/// From MPI_Init to MPI_Finalize. Process 0 and each other process exchange messages and, every second, signs
/// of life. Only a thread of this object calls MPI, since most transports allow one thread at a time and any
/// call may never return once a process is lost. It calls about once in a millisecond: waiting inside MPI
/// would keep a core busy.
class Connection {
public:
  /// A process from which nothing has come for longer than that is lost.
  Connection(int rank, int size, double patience_seconds);
  /// After leave().
  ~Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // From any thread:
  /// Returns at once; the memory of the message is kept until it is sent.
  void send(int to, const Message& message) { send(to, Tag::message, message); }
  /// The oldest message from a process, for which it waits.
  [[nodiscard]] std::optional<Message> receive(int from, double most_seconds);
  [[nodiscard]] bool is_lost(int rank) const;

  /// Waits until all others leave too, except for lost ones. False if there are lost ones: MPI_Finalize would
  /// wait for them, and this object must live as long as the process, since MPI may still use its memory.
  [[nodiscard]] bool leave();

private:
  enum class Tag : int {
    message,
    sign_of_life,
    leave, ///< a worker asks to leave; process 0 answers this if a process is lost
    finish ///< process 0 answers this if all leave
  };
  struct Transfer {
    Tag tag;
    Message message;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  struct Peer {
    std::deque<Message> inbox;
    std::deque<Transfer> outbox;
    std::size_t unsent = 0;                     // in the outbox, or on the way
    Clock::time_point last_sign = Clock::now(); // of life
    std::optional<Tag> last_word;               // leave or finish
  };

  void run(const std::stop_token& stop);
  void give_signs();
  void begin_sending();
  bool begin_receiving();
  bool finish_transfers();
  void deliver(std::size_t from, Transfer& transfer);

  void send(int to, Tag tag, const Message& message);
  template<class Condition>
  bool wait_until(const Condition& condition, int rank);
  bool let_others_leave();
  bool ask_to_leave();

  const int rank_, size_;
  const double patience_seconds_;
  std::vector<std::deque<Transfer>> outgoing_, incoming_; // of the thread: by the other process, in order
  mutable std::mutex mutex_;                              // of the members below
  std::condition_variable changed_;
  std::vector<Peer> peers_;
  bool has_ended_ = false; // the thread
  std::jthread thread_;
};

} // namespace phlux::cluster
