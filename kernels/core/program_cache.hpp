// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint::gl {

/// Linked programs in a folder, so that a driver compiles a shader once and not once a run. A
/// program belongs to the driver and the text that it was made of: after an update of either it is
/// not found again. Whole files only are ever seen, whoever else writes, and whatever cannot be
/// read or written is as if it were not there.
class ProgramCache {
 public:
  struct Program {
    unsigned format = 0;  ///< as the driver named it
    std::vector<char> bytes;
  };

  /// Where the user keeps such things: $XDG_CACHE_HOME/glint, else ~/.cache/glint, else nowhere
  /// (an empty path).
  static std::filesystem::path user_folder();

  /// `folder` is made when the first program is kept; an empty path keeps none. `driver` is all
  /// that it says of itself.
  ProgramCache(std::filesystem::path folder, std::string driver)
      : folder_(std::move(folder)), driver_(std::move(driver)) {}

  std::optional<Program> find(std::string_view text) const;
  /// In place of what was kept for the text before.
  void keep(std::string_view text, const Program& program) const;

 private:
  std::string key_of(std::string_view text) const;
  std::filesystem::path path_of(std::string_view key) const;

  std::filesystem::path folder_;
  std::string driver_;
};

}  // namespace glint::gl
