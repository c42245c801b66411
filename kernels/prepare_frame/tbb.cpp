// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>

#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"
#include "glint/kernels/prepare_frame/prepare_frame.hpp"
#include "glint/kernels/prepare_frame/streaming.hpp"

namespace glint {
namespace {

template <class T>
bool convert(const ToGrey::Args& args, const T* raw, bool (*rows)(const GreyPass<T>&, int, int),
             Workers& workers) {
  const GreyPass<T> pass{raw,
                         args.raw.pitch,
                         args.raw.width,
                         args.raw.channels,
                         args.reciprocal,
                         worth_streaming(args.grey),
                         args.reciprocal_floor,
                         ToGrey::kLargest,
                         args.grey.data,
                         args.grey.pitch};
  std::atomic<bool> masked = false;
  const Tiles tiles{static_cast<std::size_t>(args.raw.height), kRowTile};
  workers.for_tiles(tiles.tiles(), [&](std::size_t t) {
    const bool found = rows(pass, static_cast<int>(tiles.begin(t)), static_cast<int>(tiles.end(t)));
    if (found) masked.store(true, std::memory_order_relaxed);
  });
  return masked;
}

}  // namespace

void ToGrey::tbb(const Args& args, Workers& workers) {
  const auto& lanes = prepare_frame_lanes(workers.isa());
  bool masked = false;
  if (const auto* bytes = std::get_if<const std::uint8_t*>(&args.raw.data)) {
    masked = convert(args, *bytes, lanes.grey_u8, workers);
  } else if (const auto* words = std::get_if<const std::uint16_t*>(&args.raw.data)) {
    masked = convert(args, *words, lanes.grey_u16, workers);
  } else {
    masked = convert(args, std::get<const float*>(args.raw.data), lanes.grey_f32, workers);
  }
  if (args.masked != nullptr) *args.masked = masked;
}

}  // namespace glint
