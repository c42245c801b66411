// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "cli.hpp"
#include "folder.hpp"
#include "glint/frontends/files/open_source.hpp"
#include "glint/frontends/video/image_file.hpp"
#include "glint/frontends/video/overlay.hpp"

namespace glint {
namespace {

using test::Folder;
using test::has;
using test::message_of;

std::unique_ptr<Source> open(const std::string& path, std::vector<std::string>* warnings = {}) {
  SourceOptions options;
  options.warn = [warnings](const std::string& w) {
    if (warnings) warnings->push_back(w);
  };
  return open_source(std::span(&path, 1), options);
}

int count(Source& source) {
  int frames = 0;
  while (source.next()) ++frames;
  return frames;
}

TEST(Images, SixteenBitPngsArriveAsSixteenBits) {
  const Folder folder;
  for (int f = 0; f < 12; ++f) {
    const cv::Mat image(3, 5, CV_16U, cv::Scalar(40000 + f));
    cv::imwrite(folder / ("f_" + std::to_string(f) + ".png"), image);
  }
  for (const std::string& input : {folder.path(), folder / "f_%d.png"}) {
    const auto source = open(input);
    EXPECT_EQ(source->frame_count(), 12);
    for (int f = 0; f < 12; ++f) {
      const auto frame = source->next();
      ASSERT_TRUE(frame);
      const auto* const* data = std::get_if<const std::uint16_t*>(&frame->pixels.data);
      ASSERT_TRUE(data);
      EXPECT_EQ((*data)[7], 40000 + f);
    }
  }
}

TEST(Images, ColourWithAlphaKeepsItsChannels) {
  const Folder folder;
  cv::imwrite(folder / "a.png", cv::Mat(2, 2, CV_8UC4, cv::Scalar(1, 2, 3, 255)));
  const auto frame = open(folder / "a.png")->next();
  EXPECT_EQ(frame->pixels.channels, 4);
  EXPECT_EQ(std::get<const std::uint8_t*>(frame->pixels.data)[2], 3);
}

TEST(Images, PagesOfATiffAreFrames) {
  const Folder folder;
  std::vector<cv::Mat> pages;
  for (int f = 0; f < 5; ++f) pages.emplace_back(4, 3, CV_16U, cv::Scalar(1000 * f));
  cv::imwritemulti(folder / "p.tif", pages);
  const auto source = open(folder / "p.tif");
  EXPECT_EQ(source->frame_count(), 5);
  for (int f = 0; f < 5; ++f) {
    EXPECT_EQ(std::get<const std::uint16_t*>(source->next()->pixels.data)[0], 1000 * f);
  }
  EXPECT_FALSE(source->next());
}

TEST(Images, FloatTiffsReadBackExactly) {
  const Folder folder;
  Image<float> image(7, 2);
  image.view()(6, 1) = -1.25e-3f;
  write_image(folder / "f.tif", image.view(), ImageDepth::float32);
  const auto frame = open(folder / "f.tif")->next();
  EXPECT_EQ(std::get<const float*>(frame->pixels.data)[frame->pixels.pitch + 6], -1.25e-3f);
}

TEST(Images, AnotherSizeIsNamedWithBothSizes) {
  const Folder folder;
  cv::imwrite(folder / "a.png", cv::Mat(2, 3, CV_8U, cv::Scalar(0)));
  cv::imwrite(folder / "b.png", cv::Mat(4, 5, CV_8U, cv::Scalar(0)));
  const auto source = open(folder.path());
  const auto message = message_of<std::runtime_error>([&] { count(*source); });
  EXPECT_TRUE(has(message, "b.png") && has(message, "3x2") && has(message, "5x4")) << message;
}

TEST(Images, DamagedFilesAreNamed) {
  const Folder folder;
  cv::Mat noise(64, 64, CV_8UC3);
  cv::randu(noise, 0, 255);
  for (const std::string name : {"a.png", "a.jpg", "a.tif"}) {
    cv::imwrite(folder / name, noise);
    test::truncate(folder / name, 0.5);
    const auto message = message_of<std::runtime_error>([&] { count(*open(folder / name)); });
    EXPECT_TRUE(has(message, name)) << message;
  }
}

std::string write_video(const std::string& path, int frames) {
  cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, {64, 48});
  cv::Mat noise(48, 64, CV_8UC3);
  for (int f = 0; f < frames; ++f) {
    cv::randu(noise, 0, 255);
    writer.write(noise);
  }
  return path;
}

TEST(Video, FramesComeWithTheirTimes) {
  const Folder folder;
  const auto source = open(write_video(folder / "v.avi", 10));
  EXPECT_EQ(source->frame_count(), 10);
  EXPECT_DOUBLE_EQ(source->frame_rate(), 25);
  source->next();
  const auto frame = source->next();
  EXPECT_EQ(frame->pixels.width, 64);
  EXPECT_EQ(frame->pixels.channels, 3);
  EXPECT_DOUBLE_EQ(frame->time, 0.04);
  EXPECT_EQ(count(*source), 8);
}

TEST(Video, ATruncatedOneWarnsAndEndsEarly) {
  const Folder folder;
  test::truncate(write_video(folder / "v.avi", 40), 0.5);
  std::vector<std::string> warnings;
  const auto source = open(folder / "v.avi", &warnings);
  const int frames = count(*source);
  EXPECT_GT(frames, 5);
  EXPECT_LT(frames, 35);
  ASSERT_FALSE(warnings.empty());
  EXPECT_TRUE(has(warnings.back(), "v.avi") && has(warnings.back(), std::to_string(frames)));
}

TEST(Video, WhatIsNoVideoIsNamed) {
  const Folder folder;
  const auto path = folder.write("v.mp4", "not a video");
  EXPECT_TRUE(has(message_of<std::runtime_error>([&] { open(path); }), "v.mp4"));
}

TEST(Overlay, ShowsEveryFrameScaledUpAndThePictureBoth) {
  const Folder folder;
  Image<float> image(320, 64);
  image.view()(100, 30) = 50;
  Scan scan;
  scan.raw = Frame(std::move(image));
  TrackPoint p;
  p.track_id = 3, p.x = 100, p.y = 30, p.status = TrackStatus::confirmed;
  const std::vector<std::vector<TrackPoint>> reported{{p}};
  const auto video =
      overlay_video(folder / "o.mp4", 25, OverlayCodec::mpeg4, [](const std::string&) {});
  const auto picture = overlay_picture(folder / "o.png");
  for (int f = 0; f < 6; ++f) {
    scan.frame = f;
    video->take({scan, reported});
    picture->take({scan, reported});
  }
  video->finish(), picture->finish();
  const auto source = open(video->path());
  const auto frame = source->next();
  EXPECT_EQ(frame->pixels.width, 640);
  EXPECT_EQ(frame->pixels.height, 128);
  EXPECT_EQ(count(*source), 5);
  const cv::Mat both = cv::imread(folder / "o.png");
  EXPECT_EQ(both.cols, 960);
  EXPECT_EQ(both.rows, 2 * 192 + 8);
  // grey above, something coloured below
  const auto coloured = [](const cv::Mat& m) {
    std::vector<cv::Mat> bgr;
    cv::split(m, bgr);
    return cv::countNonZero(bgr[0] != bgr[1]);
  };
  EXPECT_EQ(coloured(both.rowRange(0, 192)), 0);
  EXPECT_GT(coloured(both.rowRange(200, 392)), 50);
}

/// The tag of a video's codec: "mp4v", "avc1" and the like.
std::string codec_of(const std::string& path) {
  const auto tag = static_cast<unsigned>(cv::VideoCapture(path).get(cv::CAP_PROP_FOURCC));
  std::string letters;
  for (int i = 0; i < 4; ++i) letters += static_cast<char>(tag >> (8 * i) & 0xff);
  return letters;
}

TEST(Overlay, IsMpeg4UnlessH264IsAskedFor) {
  const Folder folder;
  const std::string track = "track " + test::cube(folder, 64, 48, 3, 1, 1) +
                            " --tracker smc-phd --quiet --overlay " + (folder / "o.mp4");
  const test::Result plain = test::glint(folder, track);
  EXPECT_EQ(plain.err, "");
  EXPECT_EQ(codec_of(folder / "o.mp4"), "mp4v");
  const test::Result asked = test::glint(folder, track + " --overlay-codec h264");
  if (asked.err.empty()) {
    EXPECT_EQ(codec_of(folder / "o.mp4"), "avc1");
  } else {
    EXPECT_TRUE(has(asked.err, "no H.264 encoder here; writing MPEG-4")) << asked.err;
    EXPECT_EQ(codec_of(folder / "o.mp4"), "mp4v");
  }
  test::expect_error(test::glint(folder, track + " --overlay-codec mjpg"), 2, "--overlay-codec");
}

TEST(Overlay, UnwritablePathsAreFoundOutAtOnce) {
  const Folder folder;
  const auto warn = [](const std::string&) {};
  EXPECT_THROW(overlay_video(folder / "no/o.mp4", 25, OverlayCodec::mpeg4, warn), UsageError);
  EXPECT_THROW(overlay_video(folder / "o.gif", 25, OverlayCodec::mpeg4, warn), UsageError);
  EXPECT_THROW(overlay_picture(folder / "no/o.png"), UsageError);
  EXPECT_THROW(overlay_picture(folder / "o.doc"), UsageError);
}

}  // namespace
}  // namespace glint
