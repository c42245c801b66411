// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "glint/kernels/core/random.hpp"
#include "glint/kernels/core/trial.hpp"

namespace glint {

enum class Resampling { systematic, residual };

/// An array of 4-byte elements that moves with its particles: destination[j] =
/// source[ancestors[j]].
struct MovedArray {
  const void* source;
  void* destination;

  /// Copies element `from` of the source to element `to` of the destination, of whatever type.
  void move(std::size_t from, std::size_t to) const {
    std::memcpy(static_cast<std::byte*>(destination) + 4 * to,
                static_cast<const std::byte*>(source) + 4 * from, 4);
  }
};

/// Memory that resample keeps from call to call, so that a warm call allocates nothing.
struct ResampleWorkspace {
  struct Block {
    std::int64_t copies, mass;  ///< sums before the block
    std::int32_t begin;         ///< its first offspring
  };
  struct Unit {
    std::uint32_t block, piece;
  };
  std::vector<Block> blocks;
  std::vector<Unit> units;
};

/// Draws ancestors in proportion to weights. Weights are first rounded to whole numbers of at most
/// 2^28 (fewer above 2^24 particles or offspring), so that all sums are exact in double in any
/// order and the ancestors are the same on every device. Ancestors ascend. Negative and NaN weights
/// count 0; if all are 0 the weights count as equal. With w normalised, a particle has less than
/// one offspring more or fewer than L w (systematic), or at least floor(L w) (residual). Throws
/// std::invalid_argument for offspring of no particles and above kMaxCount.
struct Resample {
  static constexpr std::string_view name = "resample";
  static constexpr Tolerance tolerance{};                         // equal
  static constexpr std::size_t kMaxCount = std::size_t{1} << 25;  ///< of particles, of offspring

  struct Args {
    std::span<const float> weights;
    std::span<std::uint32_t> ancestors;  ///< written; its length is the number of offspring
    Resampling method = Resampling::systematic;
    RandomKey key = {};
    std::span<const MovedArray> moved = {};  ///< gathered by the ancestors in the same pass; a
                                             ///< destination must not overlap any source
    ResampleWorkspace* workspace = nullptr;
  };
  static void serial(const Args& args);
  static void tbb(const Args& args, Workers& workers);
  static void egl(const Args& args, gl::Context& context);
  static WholeCall whole(const Args& args);
  static std::vector<std::unique_ptr<Trial>> trials();
};

}  // namespace glint
