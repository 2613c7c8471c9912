#ifdef PHLUX_MPI

#include "cluster/connection.h"

#include <chrono>
#include <utility>

namespace phlux::cluster {
namespace {

using namespace std::chrono_literals;

// Lets MPI continue with a transfer.
bool is_done(MPI_Request& request) {
  int done = 0;
  return MPI_Test(&request, &done, MPI_STATUS_IGNORE) == MPI_SUCCESS && done != 0;
}

} // namespace

Connection::Connection(int rank, int size, double patience_seconds)
    : rank_(rank), size_(size), patience_seconds_(patience_seconds),
      outgoing_(static_cast<std::size_t>(size)), incoming_(static_cast<std::size_t>(size)),
      peers_(static_cast<std::size_t>(size)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

void Connection::run(const std::stop_token& stop) {
  Clock::time_point next_signs = Clock::now();
  while (!stop.stop_requested()) {
    if (Clock::now() >= next_signs) {
      give_signs();
      next_signs = Clock::now() + 1s;
    }
    begin_sending();
    const bool has_come = begin_receiving(), all_done = finish_transfers();
    if (!has_come) std::this_thread::sleep_for(all_done ? 1000us : 200us);
  }
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  changed_.notify_all();
}

void Connection::give_signs() {
  for (int other = 0; other < size_; ++other)
    if (other != rank_ && (rank_ == 0 || other == 0)) {
      MPI_Request request = MPI_REQUEST_NULL;
      MPI_Isend(nullptr, 0, MPI_UINT64_T, other, static_cast<int>(Tag::sign_of_life), MPI_COMM_WORLD,
                &request);
      if (request != MPI_REQUEST_NULL) MPI_Request_free(&request);
    }
}

void Connection::begin_sending() {
  for (int to = 0; to < size_; ++to) {
    const auto other = static_cast<std::size_t>(to);
    std::deque<Transfer> transfers;
    {
      const std::lock_guard lock(mutex_);
      transfers.swap(peers_[other].outbox);
    }
    for (Transfer& transfer : transfers) {
      // After an error the request is null, and the message counts as sent: the process is lost.
      MPI_Isend(transfer.message.bytes.get(), static_cast<int>(transfer.message.size / sizeof(std::uint64_t)),
                MPI_UINT64_T, to, static_cast<int>(transfer.tag), MPI_COMM_WORLD, &transfer.request);
      outgoing_[other].push_back(std::move(transfer));
    }
  }
}

// Whether a message has come.
bool Connection::begin_receiving() {
  MPI_Status status;
  int is_there = 0;
  MPI_Message handle = MPI_MESSAGE_NULL;
  if (MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &handle, &status) != MPI_SUCCESS ||
      is_there == 0)
    return false;
  int words = 0;
  MPI_Get_count(&status, MPI_UINT64_T, &words);
  Message message;
  message.size = static_cast<std::size_t>(words) * sizeof(std::uint64_t);
  message.bytes = std::make_shared_for_overwrite<std::byte[]>(message.size);
  const auto from = static_cast<std::size_t>(status.MPI_SOURCE);
  Transfer& transfer =
      incoming_[from].emplace_back(Transfer{static_cast<Tag>(status.MPI_TAG), std::move(message)});
  if (MPI_Imrecv(transfer.message.bytes.get(), words, MPI_UINT64_T, &handle, &transfer.request) !=
      MPI_SUCCESS)
    incoming_[from].pop_back();
  const std::lock_guard lock(mutex_);
  peers_[from].last_sign = Clock::now(); // a long message may take its time
  return true;
}

// Messages of one process are delivered in the order in which it sent them. False while some are on the way.
bool Connection::finish_transfers() {
  bool all_done = true;
  for (std::size_t other = 0; other < peers_.size(); ++other) {
    std::deque<Transfer>&out = outgoing_[other], &in = incoming_[other];
    while (!out.empty() && is_done(out.front().request)) {
      out.pop_front();
      const std::lock_guard lock(mutex_);
      --peers_[other].unsent;
      changed_.notify_all();
    }
    while (!in.empty() && is_done(in.front().request)) {
      deliver(other, in.front());
      in.pop_front();
    }
    all_done = all_done && out.empty() && in.empty();
  }
  return all_done;
}

void Connection::deliver(std::size_t from, Transfer& transfer) {
  const std::lock_guard lock(mutex_);
  Peer& peer = peers_[from];
  peer.last_sign = Clock::now();
  if (transfer.tag == Tag::message) peer.inbox.push_back(std::move(transfer.message));
  if (transfer.tag == Tag::leave || transfer.tag == Tag::finish) peer.last_word = transfer.tag;
  changed_.notify_all();
}

void Connection::send(int to, Tag tag, const Message& message) {
  const std::lock_guard lock(mutex_);
  Peer& peer = peers_[static_cast<std::size_t>(to)];
  peer.outbox.push_back({tag, message});
  ++peer.unsent;
}

std::optional<Message> Connection::receive(int from, double most_seconds) {
  std::unique_lock lock(mutex_);
  std::deque<Message>& inbox = peers_[static_cast<std::size_t>(from)].inbox;
  if (!changed_.wait_for(lock, std::chrono::duration<double>(most_seconds), [&] { return !inbox.empty(); }))
    return std::nullopt;
  Message message = std::move(inbox.front());
  inbox.pop_front();
  return message;
}

bool Connection::is_lost(int rank) const {
  const std::lock_guard lock(mutex_);
  return seconds_since(peers_[static_cast<std::size_t>(rank)].last_sign) > patience_seconds_;
}

// `condition` is about a process. False if that is lost before.
template<class Condition>
bool Connection::wait_until(const Condition& condition, int rank) {
  const Peer& peer = peers_[static_cast<std::size_t>(rank)];
  std::unique_lock lock(mutex_);
  const auto is_over = [&] { return condition(peer); };
  while (!changed_.wait_for(lock, 100ms, is_over))
    if (seconds_since(peer.last_sign) > patience_seconds_) return false;
  return true;
}

bool Connection::let_others_leave() {
  const auto asks = [](const Peer& peer) { return peer.last_word.has_value(); };
  const auto all_sent = [](const Peer& peer) { return peer.unsent == 0; };
  bool all = true;
  for (int other = 1; other < size_; ++other) all = wait_until(asks, other) && all;
  for (int other = 1; other < size_; ++other) send(other, all ? Tag::finish : Tag::leave, {});
  for (int other = 1; other < size_; ++other) all = wait_until(all_sent, other) && all;
  return all;
}

bool Connection::ask_to_leave() {
  send(0, Tag::leave, {});
  bool all = false;
  const auto answers = [&](const Peer& peer) {
    all = peer.last_word == Tag::finish;
    return peer.last_word.has_value();
  };
  return wait_until(answers, 0) && all;
}

bool Connection::leave() {
  const bool all = rank_ == 0 ? let_others_leave() : ask_to_leave();
  thread_.request_stop();
  std::unique_lock lock(mutex_);
  const bool has_ended =
      changed_.wait_for(lock, duration_of(all ? patience_seconds_ : 1.0), [&] { return has_ended_; });
  lock.unlock();
  if (has_ended) thread_.join();
  return all && has_ended;
}

} // namespace phlux::cluster

#endif
