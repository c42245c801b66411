// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <mutex>
#include <optional>
#include <string>

#include "glint/frontends/mpi/mpi_team.hpp"

namespace glint::cli {

/// The processes of MPI. Rank 0 leads: it hands out runs one by one, to its own threads and to
/// those of the others as they ask, so that fast ones do more, and takes all results.
class RunExchange : public ProcessTeam {
 public:
  RunExchange();            ///< begins MPI; throws std::runtime_error without its thread support
  ~RunExchange() override;  ///< ends it, once every process gets here
  RunExchange(const RunExchange&) = delete;
  RunExchange& operator=(const RunExchange&) = delete;

  bool leads() const override { return rank_ == 0; }
  void share(std::span<const RunId> runs, Workers& workers, const DoRun& work,
             const TakeRun& take) override;
  void fail(const std::string& why) override;

 private:
  struct Question;
  void lead(std::span<const RunId> runs, Workers& workers, const DoRun& work, const TakeRun& take);
  void follow(Workers& workers, const DoRun& work);
  int other_lanes(int lanes);
  bool take_question(Question& question);
  std::optional<RunId> ask(int lane, const RunId* done, const std::string& bytes);
  template <class F>
  void or_fail(const F& f);

  int rank_ = 0, size_ = 1;
  std::mutex mutex_;  ///< MPI is called by one thread at a time
};

}  // namespace glint::cli
