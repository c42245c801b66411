// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/mpi/run_exchange.hpp"

#include <fmt/core.h>
#include <mpi.h>

#include <chrono>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <thread>

namespace glint::cli {
namespace {

constexpr int kQuestion = 1, kFirstAnswer = 2;  // tags; an answer's is its lane's
// MPI waits by turning in circles: a sleep leaves the processor to the runs.
constexpr std::chrono::microseconds kNap(200);

/// What a lane, one of a process's threads, tells before it asks for another run; the result of
/// the one that it has done follows.
struct QuestionHead {
  int lane = 0;
  bool done = false;
  RunId id;
};

struct Answer {
  bool more = false;
  RunId id;
};

}  // namespace

struct RunExchange::Question {
  QuestionHead head;
  int from = 0;
  std::string result;
};

RunExchange::RunExchange() {
  int support = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &support);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  if (support < MPI_THREAD_SERIALIZED) {
    throw std::runtime_error("this MPI is built without thread support; use another one");
  }
}

RunExchange::~RunExchange() { MPI_Finalize(); }

void RunExchange::fail(const std::string& why) {
  fmt::print(stderr, "glint: process {} of {} failed: {}\n", rank_, size_, why);
  MPI_Abort(MPI_COMM_WORLD, 1);
}

/// The others wait for what this process cannot give any more: they are ended.
template <class F>
void RunExchange::or_fail(const F& f) {
  try {
    f();
  } catch (const std::exception& e) {
    fail(e.what());
  }
}

void RunExchange::share(std::span<const RunId> runs, Workers& workers, const DoRun& work,
                        const TakeRun& take) {
  leads() ? lead(runs, workers, work, take) : follow(workers, work);
}

void RunExchange::lead(std::span<const RunId> runs, Workers& workers, const DoRun& work,
                       const TakeRun& take) {
  std::mutex mutex;
  std::size_t given = 0;
  const auto next = [&]() -> std::optional<RunId> {
    const std::lock_guard lock(mutex);
    return given < runs.size() ? std::optional(runs[given++]) : std::nullopt;
  };
  const auto take_one = [&](RunId id, const std::string& bytes) {
    const std::lock_guard lock(mutex);
    take(id, bytes);
  };
  const auto serve = [&](int lanes) {
    for (Question asked; lanes > 0;) {
      if (!take_question(asked)) continue;
      if (asked.head.done) take_one(asked.head.id, asked.result);
      const std::optional<RunId> run = next();
      const Answer answer{run.has_value(), run.value_or(RunId{})};
      const std::lock_guard lock(mutex_);
      MPI_Send(&answer, sizeof answer, MPI_BYTE, asked.from, kFirstAnswer + asked.head.lane,
               MPI_COMM_WORLD);
      lanes -= !run;
    }
  };
  const int lanes = other_lanes(0);
  std::thread server([&] { or_fail([&] { serve(lanes); }); });
  workers.for_tiles(static_cast<std::size_t>(workers.threads()), [&](std::size_t) {
    or_fail([&] {
      while (const auto run = next()) take_one(*run, work(*run));
    });
  });
  server.join();
}

void RunExchange::follow(Workers& workers, const DoRun& work) {
  other_lanes(workers.threads());
  workers.for_tiles(static_cast<std::size_t>(workers.threads()), [&](std::size_t lane) {
    or_fail([&] {
      std::optional<RunId> run = ask(static_cast<int>(lane), nullptr, {});
      while (run) run = ask(static_cast<int>(lane), &*run, work(*run));
    });
  });
}

/// The sum over the processes, at the leader.
int RunExchange::other_lanes(int lanes) {
  int sum = 0;
  MPI_Reduce(&lanes, &sum, 1, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
  return sum;
}

/// False, after a nap, if nobody asks.
bool RunExchange::take_question(Question& question) {
  {
    const std::lock_guard lock(mutex_);
    int there = 0, size = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kQuestion, MPI_COMM_WORLD, &there, &status);
    if (there != 0) {
      MPI_Get_count(&status, MPI_BYTE, &size);
      std::string bytes(static_cast<std::size_t>(size), '\0');
      MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, kQuestion, MPI_COMM_WORLD,
               MPI_STATUS_IGNORE);
      std::memcpy(&question.head, bytes.data(), sizeof question.head);
      question.from = status.MPI_SOURCE;
      question.result = bytes.substr(sizeof question.head);
      return true;
    }
  }
  std::this_thread::sleep_for(kNap);
  return false;
}

/// Hands in a run that is done, if there is one, and waits for the next.
std::optional<RunId> RunExchange::ask(int lane, const RunId* done, const std::string& bytes) {
  const QuestionHead head{lane, done != nullptr, done != nullptr ? *done : RunId{}};
  std::string message(reinterpret_cast<const char*>(&head), sizeof head);
  message += bytes;
  Answer answer;
  MPI_Request request = MPI_REQUEST_NULL;
  {
    const std::lock_guard lock(mutex_);
    MPI_Irecv(&answer, sizeof answer, MPI_BYTE, 0, kFirstAnswer + lane, MPI_COMM_WORLD, &request);
    MPI_Send(message.data(), static_cast<int>(message.size()), MPI_BYTE, 0, kQuestion,
             MPI_COMM_WORLD);
  }
  for (int there = 0;;) {
    {
      const std::lock_guard lock(mutex_);
      MPI_Test(&request, &there, MPI_STATUS_IGNORE);
    }
    if (there != 0) return answer.more ? std::optional(answer.id) : std::nullopt;
    std::this_thread::sleep_for(kNap);
  }
}

}  // namespace glint::cli
