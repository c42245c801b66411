// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "glint/engine/state/bytes.hpp"

namespace glint {

/// What a checkpoint was made by. It goes on only where all of it but the frame is the same.
struct CheckpointLabel {
  std::string version;                ///< of the library
  std::string maker;                  ///< "Engine" or "Scheduler"
  std::string device;                 ///< its kind
  std::vector<std::string> trackers;  ///< their names, in their order
  std::string settings;               ///< TOML; empty if the maker was not told
  std::int64_t frame = 0;             ///< the next one, counted from 0
};
auto fields(OneOf<CheckpointLabel> auto& l) {
  return std::tie(l.version, l.maker, l.device, l.trackers, l.settings, l.frame);
}

/// The library's version, "0.1.0".
std::string_view library_version();

/// Begins a checkpoint: magic, format, room for a checksum over all that follows it, label. The
/// state comes behind; then seal_checkpoint() gives the bytes.
ByteWriter begin_checkpoint(const CheckpointLabel& label);
std::string seal_checkpoint(ByteWriter&& checkpoint);

/// A checkpoint whose magic, format and checksum are right.
struct OpenCheckpoint {
  CheckpointLabel label;
  ByteReader state;
};
/// Throws CheckpointError.
OpenCheckpoint open_checkpoint(std::string_view bytes);
/// Throws CheckpointError that says what differs first.
void require_same(const CheckpointLabel& made, const CheckpointLabel& here);

/// Runs restore(), whose readers refuse bytes by exceptions of many kinds. Memory that runs out
/// says nothing of the bytes.
template <class Restore>
void refuse_damaged(const Restore& restore) {
  try {
    restore();
  } catch (const CheckpointError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw CheckpointError("the checkpoint is damaged: " + std::string(e.what()));
  }
}

}  // namespace glint
