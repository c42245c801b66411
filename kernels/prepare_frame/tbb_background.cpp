// SPDX-License-Identifier: Apache-2.0
#include "glint/kernels/core/tiles.hpp"
#include "glint/kernels/prepare_frame/background.hpp"
#include "glint/kernels/prepare_frame/lanes.hpp"
#include "glint/kernels/prepare_frame/median_network.hpp"

namespace glint {
namespace {

constexpr std::size_t kMedianRows = 32;

template <class T>
void run_stack(std::span<const ImageView<const T>> images, ImageView<float> median,
               void (*rows)(const StackPass<T>&, int, int), Workers& workers) {
  const MedianNetwork network = median_network(static_cast<int>(images.size()));
  StackPass<T> pass{};
  for (std::size_t i = 0; i < images.size(); ++i) {
    pass.images[i] = images[i].data, pass.pitches[i] = images[i].pitch;
  }
  pass.width = median.width;
  pass.median = median.data, pass.median_pitch = median.pitch;
  pass.network = &network;
  const Tiles tiles{static_cast<std::size_t>(median.height), kMedianRows};
  workers.for_tiles(tiles.tiles(), [&](std::size_t t) {
    rows(pass, static_cast<int>(tiles.begin(t)), static_cast<int>(tiles.end(t)));
  });
}

}  // namespace

void StackMedian::tbb(const Args& args, Workers& workers) {
  const auto& lanes = prepare_frame_lanes(workers.isa());
  if (const auto* bytes = std::get_if<0>(&args.stack)) {
    run_stack(*bytes, args.median, lanes.stack_u8, workers);
  } else if (const auto* words = std::get_if<1>(&args.stack)) {
    run_stack(*words, args.median, lanes.stack_u16, workers);
  } else {
    run_stack(std::get<2>(args.stack), args.median, lanes.stack_f32, workers);
  }
}

void SpatialMedian::tbb(const Args& args, Workers& workers) {
  const auto& lanes = prepare_frame_lanes(workers.isa());
  const MedianNetwork network = median_network(25);
  const LatticePass pass{args.image.data, args.image.pitch, args.image.width,  args.image.height,
                         args.spacing,    args.median.data, args.median.pitch, &network};
  const Tiles tiles{static_cast<std::size_t>(args.image.height), kMedianRows};
  workers.for_tiles(tiles.tiles(), [&](std::size_t t) {
    lanes.lattice(pass, static_cast<int>(tiles.begin(t)), static_cast<int>(tiles.end(t)));
  });
}

}  // namespace glint
