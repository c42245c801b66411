// SPDX-License-Identifier: Apache-2.0
// Frames without a header from files and pipes, and tracks on standard output.
#include "glint/frontends/files/raw_stream.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "cli.hpp"
#include "glint/frontends/usage_error.hpp"

namespace glint {
namespace {

using test::Folder;
using test::message_of;

constexpr int kWidth = 48, kHeight = 32, kFrames = 12;

/// A bright target that moves to the right over ripples [grey levels].
std::vector<std::uint16_t> picture(int frame) {
  std::vector<std::uint16_t> pixels;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double dx = x - 8 - 1.5 * frame, dy = y - 14 - 0.5 * frame;
      const int ripple = (7 * x + 5 * y + 11 * frame + x * y) % 23;
      pixels.push_back(
          static_cast<std::uint16_t>(100 + ripple + 90 * std::exp(-dx * dx - dy * dy)));
    }
  }
  return pixels;
}

template <class T>
std::string bytes_of(int frame) {
  const auto pixels = picture(frame);
  const std::vector<T> narrowed(pixels.begin(), pixels.end());
  return {reinterpret_cast<const char*>(narrowed.data()), narrowed.size() * sizeof(T)};
}

template <class T>
std::string clip() {
  std::string bytes;
  for (int f = 0; f < kFrames; ++f) bytes += bytes_of<T>(f);
  return bytes;
}

const std::string kTrack =
    "track - --tracker smc-phd --quiet --set frames.background=none --size 48x32 ";

/// The lines of tracks, without the first, which says what the run was told.
std::string points_in(const std::string& lines) { return lines.substr(lines.find('\n') + 1); }

std::string piped(const Folder& folder, const std::string& bytes, const std::string& format) {
  const std::string raw = folder.write("clip.raw", bytes);
  const auto run = test::glint(folder, kTrack + "--format " + format + " --out - < " + raw);
  EXPECT_EQ(run.code, 0) << run.err;
  return points_in(run.out);
}

TEST(RawStream, APipeOfAnyPixelsGivesTheTracksOfAFile) {
  const Folder folder;
  NpyWriter cube(folder / "clip.npy");
  for (int f = 0; f < kFrames; ++f) {
    Image<float> image(kWidth, kHeight);
    const auto pixels = picture(f);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      image.view()(static_cast<int>(i) % kWidth, static_cast<int>(i) / kWidth) = pixels[i];
    }
    cube.write(image.view());
  }
  const std::string tracks = folder / "tracks.jsonl";
  const auto run = test::glint(folder, "track " + (folder / "clip.npy") +
                                           " --tracker smc-phd --quiet --set "
                                           "frames.background=none --out " +
                                           tracks);
  ASSERT_EQ(run.code, 0) << run.err;
  std::string expected = points_in(test::content_of(tracks));
  // A pipe has no room in its first line, so what was estimated comes last there.
  const auto rows = [](const std::string& lines) {
    std::string only;
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);) {
      if (test::has(line, "track_id")) only += line + '\n';
    }
    return only;
  };
  expected = rows(expected);
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(rows(piped(folder, clip<std::uint8_t>(), "gray8")), expected);
  EXPECT_EQ(rows(piped(folder, clip<std::uint16_t>(), "gray16le")), expected);
  EXPECT_EQ(rows(piped(folder, clip<float>(), "grayf32le")), expected);
}

/// Waits until something can be read, at most `seconds`.
bool readable(int file, int seconds) {
  pollfd poll_of{file, POLLIN, 0};
  return poll(&poll_of, 1, 1000 * seconds) == 1;
}

// Nothing waits for a later frame: what is known of a frame comes out before the next one is sent.
TEST(RawStream, TracksComeOutAsFramesGoIn) {
  const Folder folder;
  std::signal(SIGPIPE, SIG_IGN);  // a program that ends early is a failure, not the end
  const std::string in = folder / "in.fifo", out = folder / "out.fifo";
  ASSERT_EQ(mkfifo(in.c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(out.c_str(), 0600), 0);
  std::thread program([&] {
    const auto run =
        test::glint(folder, kTrack + "--format gray16le --out - < " + in + " > " + out);
    EXPECT_EQ(run.code, 0) << run.err;
  });
  const int frames = open(in.c_str(), O_WRONLY), tracks = open(out.c_str(), O_RDONLY);
  std::string text;
  std::int64_t last = -1;
  for (int f = 0; f < kFrames; ++f) {
    const std::string bytes = bytes_of<std::uint16_t>(f);
    EXPECT_EQ(write(frames, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    if (f < 3) continue;  // until then there may be no track
    while (last < f && readable(tracks, 20)) {
      std::array<char, 65536> buffer;
      const ssize_t n = ::read(tracks, buffer.data(), buffer.size());
      if (n <= 0) break;
      text.append(buffer.data(), static_cast<std::size_t>(n));
      const std::size_t end = text.rfind('\n'), begin = text.rfind('\n', end - 1) + 1;
      if (end == std::string::npos) continue;
      const auto line = nlohmann::json::parse(text.substr(begin, end - begin));
      if (line.contains("frame")) last = line["frame"].get<std::int64_t>();
    }
    EXPECT_EQ(last, f);
    if (last != f) break;
  }
  close(frames);
  while (readable(tracks, 20)) {
    std::array<char, 4096> rest;
    if (::read(tracks, rest.data(), rest.size()) <= 0) break;
  }
  program.join();
  close(tracks);
}

TEST(RawStream, AStreamThatEndsInAFrameKeepsWhatWasTracked) {
  const Folder folder;
  const std::string whole = clip<std::uint8_t>();
  const std::string raw = folder.write("clip.raw", whole.substr(0, whole.size() - 100));
  const auto run = test::glint(folder, kTrack + "--format gray8 --out - < " + raw);
  test::expect_error(run, 1, "standard input: ends after 1436 of the 1536 bytes of frame 11");
  EXPECT_TRUE(test::has(run.out, "\"frame\":10"));
}

TEST(RawStream, FilesAreReadTooAndNothingIsAnEmptyStream) {
  const Folder folder;
  const std::string raw = folder.write("clip.raw", clip<std::uint8_t>());
  const auto source = open_raw(raw, raw_format("gray8", "48x32"), 4);
  int frames = 0;
  while (const auto frame = source->next()) EXPECT_DOUBLE_EQ(frame->time, 0.25 * frames++);
  EXPECT_EQ(frames, kFrames);
  EXPECT_FALSE(open_raw(folder.write("empty.raw", ""), raw_format("gray8", "48x32"))->next());
}

TEST(RawStream, AShortMemoryWritesTheSameTracks) {
  const Folder folder;
  const std::string raw = folder.write("clip.raw", clip<std::uint8_t>());
  const std::string track = kTrack + "--format gray8 --out - < " + raw;
  const auto whole = test::glint(folder, track),
             brief = test::glint(folder, track + " --set keep=3");
  ASSERT_EQ(brief.code, 0) << brief.err;
  EXPECT_FALSE(points_in(whole.out).empty());
  EXPECT_EQ(points_in(brief.out), points_in(whole.out));
}

TEST(RawStream, MistakesAreNamed) {
  const Folder folder;
  const auto refusal = [](const char* pixel, const char* size) {
    return message_of<UsageError>([&] { raw_format(pixel, size); });
  };
  EXPECT_TRUE(test::has(refusal("rgb", "48x32"), "gray8, gray16le or grayf32le, got \"rgb\""));
  for (const char* size : {"", "48", "48x", "0x5", "48x32x1", "-1x4", "70000x4"}) {
    EXPECT_TRUE(test::has(refusal("gray8", size), "such as 640x512")) << size;
  }
  test::expect_error(test::glint(folder, "track - --tracker smc-phd"), 2,
                     "need --format and --size");
  test::expect_error(
      test::glint(folder, "track no.raw --tracker smc-phd --format gray8 --size 4x4"), 2,
      "no.raw: cannot be read");
  test::expect_error(
      test::glint(folder, kTrack + "--format gray8 --tracker viterbi --out - < /dev/null"), 2,
      "give the others a file");
}

}  // namespace
}  // namespace glint
