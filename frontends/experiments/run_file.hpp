// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "glint/experiments/runs.hpp"

namespace glint {

/// What the runs of a file were made from: lines "key value".
using RunOrigin = std::vector<std::string>;

/// Finished runs of one experiment in a file: a header that names their origin, then a record for
/// each run, appended and handed to the system as it finishes. A last record that was cut short is
/// dropped. One process at a time.
class RunFile : public RunStore {
 public:
  /// Makes the file if it is not there. Throws UsageError if it cannot be opened, is open
  /// elsewhere, or holds runs of another origin.
  RunFile(const std::string& path, const RunOrigin& origin);
  ~RunFile() override;
  RunFile(const RunFile&) = delete;
  RunFile& operator=(const RunFile&) = delete;

  std::size_t kept() const { return records_.size(); }
  std::optional<std::string> find(RunId id) override;
  void keep(RunId id, const std::string& bytes) override;

 private:
  struct Place {
    std::uint64_t at, size;  ///< of the result, in the file [bytes]
  };
  void open_header(const std::string& header);
  void find_records(std::uint64_t from);
  void drop_rest();
  std::string read(std::uint64_t at, std::uint64_t size) const;
  void append(const std::string& bytes);

  std::string path_;
  int file_;
  std::uint64_t end_ = 0;  ///< of the last whole record
  std::map<RunId, Place> records_;
};

/// The file of an experiment in `folder`: one for every name, seed and device.
std::string run_file_name(const std::string& folder, const std::string& experiment,
                          std::uint64_t seed, const std::string& device);

/// A digest of the running program: what is settled in its code is part of a run's origin.
std::string program_digest();

}  // namespace glint
