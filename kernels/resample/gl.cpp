// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <utility>

#include "glint/kernels/core/gl_context.hpp"
#include "glint/kernels/core/gl_queue.hpp"
#include "glint/kernels/core/inline.hpp"
#include "glint/kernels/resample/check.hpp"
#include "glint/kernels/resample/shares.hpp"
#include "glint_shaders/resample.hpp"

namespace glint {
namespace {

#include "glint/kernels/resample/pass.glsl"
constexpr const gl::Shader& kShader = shaders::resample;

struct Words {
  uint word[2];
};
void set(uint (&words)[2], double value) {
  const auto [word] = std::bit_cast<Words>(value);
  std::copy_n(word, 2, words);
}

void set_points(DrawPass& pass, resample::Points points) {
  set(pass.rate, points.rate), set(pass.lead, points.lead);
}

/// Sums of copies and of mass.
struct Sums {
  double copies = 0, mass = 0;
};

/// One call: the problem and its memory on the device.
class DeviceDrawing {
 public:
  DeviceDrawing(gl::Queue& queue, const Resample::Args& args)
      : queue_(queue),
        args_(args),
        chunks_((args.weights.size() + kChunk - 1) / kChunk),
        weights_(queue.upload(args.weights)),
        largest_(queue.buffer<uint>(chunks_)),
        sums_(queue.buffer<Sums>(chunks_)),
        before_(queue.buffer<int>(args.weights.size())),
        ancestors_(queue.output(args.ancestors)) {
    pass_.particles = static_cast<uint>(args.weights.size());
    pass_.offspring = static_cast<uint>(args.ancestors.size());
  }

  void run() {
    set_rule();
    dispatch("count_before", chunks_);
    dispatch("draw", args_.ancestors.size());
    queue_.read(ancestors_, args_.ancestors);
    for (const MovedArray& array : args_.moved) move(array);
  }

 private:
  void dispatch(std::string_view pass, std::size_t items) {
    queue_.run(kShader, pass, items, pass_, {&weights_, &largest_, &sums_, &before_, &ancestors_});
  }

  float largest() {
    dispatch("find_largest", chunks_);
    std::vector<uint> found(chunks_);
    queue_.read(largest_, std::span(found));
    return std::bit_cast<float>(*std::ranges::max_element(found));
  }

  /// Sums of all; leaves the sums before each chunk on the device. Exact: whole numbers in double.
  Sums scan() {
    dispatch("add_up", chunks_);
    std::vector<Sums> sums(chunks_);
    queue_.read(sums_, std::span(sums));
    Sums before;
    for (Sums& sum : sums) {
      const Sums own = std::exchange(sum, before);
      before.copies += own.copies;
      before.mass += own.mass;
    }
    queue_.write(sums_, std::span(sums));
    return before;
  }

  void set_rule() {
    const std::size_t count = args_.ancestors.size();
    const int bits = resample::bits(args_.weights.size(), count);
    const resample::Scale scale = resample::scale_of(largest(), bits);
    set(pass_.factor, scale.factor), set(pass_.offset, scale.offset);
    Sums all = scan();
    if (args_.method == Resampling::residual) {
      const resample::Splitter splitter = resample::splitter_of(all.mass, count, bits);
      pass_.splits = 1;
      set(pass_.count, splitter.count), set(pass_.total, splitter.total);
      set(pass_.inverse, splitter.inverse), set(pass_.remainder_factor, splitter.remainder_factor);
      all = scan();
    }
    const uint word = random_words(args_.key, 0).w[0];
    set_points(pass_, resample::points_of(all.mass, static_cast<double>(count) - all.copies, word));
  }

  void move(MovedArray array) {
    const std::span from(static_cast<const uint*>(array.source), args_.weights.size());
    const std::span to(static_cast<uint*>(array.destination), args_.ancestors.size());
    const gl::Buffer source = queue_.upload(from), destination = queue_.output(to);
    queue_.run(kShader, "gather", args_.ancestors.size(), pass_,
               {&weights_, &largest_, &sums_, &before_, &ancestors_, &source, &destination});
    queue_.read(destination, to);
  }

  gl::Queue& queue_;
  const Resample::Args& args_;
  std::size_t chunks_;
  gl::Buffer weights_, largest_, sums_, before_, ancestors_;
  DrawPass pass_{};
};

}  // namespace

WholeCall Resample::whole(const Args& args) {
  WholeCall call{sizeof(uint) * std::max(args.weights.size(), args.ancestors.size()),
                 {region_of(args.weights)},
                 {region_of(args.ancestors)}};
  for (const MovedArray& array : args.moved) {
    call.read.push_back(
        region_of(std::span(static_cast<const uint*>(array.source), args.weights.size())));
    call.written.push_back(
        region_of(std::span(static_cast<uint*>(array.destination), args.ancestors.size())));
  }
  return call;
}

void Resample::egl(const Args& args, gl::Context& context) {
  resample::check(args);
  if (args.ancestors.empty()) return;
  context.run([&](gl::Queue& queue) { DeviceDrawing(queue, args).run(); });
}

}  // namespace glint
