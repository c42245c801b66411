// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/cli/track_outputs.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "glint/frontends/modules/video.hpp"

namespace glint::cli {
namespace {

/// "out/tracks.csv" to "out/tracks.smc-phd.csv"
std::string path_for(const std::string& path, const std::string& tracker) {
  const std::size_t name = path.find_last_of('/') + 1;  // npos + 1 = 0
  const std::size_t dot = std::min(path.find('.', name + 1), path.size());
  return path.substr(0, dot) + '.' + tracker + path.substr(dot);
}

/// `option` asks for the file.
const VideoFunctions& video_for(const std::string& path, const char* option) {
  if (!has_video()) {
    throw UsageError(path + ": this glint was built without OpenCV; leave " + option + " out");
  }
  return video();
}

}  // namespace

TrackOutputs::TrackOutputs(const OutputOptions& options, const FrameJob& job, double frame_rate,
                           const Scheduler& scheduler)
    : scheduler_(scheduler), keep_(job.run().keep) {
  for (const std::string& path : options.tracks) {
    for (std::size_t i = 0; i < job.trackers.size(); ++i) {
      const std::string& tracker = job.trackers[i];
      const std::string file = job.trackers.size() > 1 ? path_for(path, tracker) : path;
      tracks_.push_back({i, TrackFile(file, {tracker, bare_toml(job.sections)}, options.file)});
    }
  }
  if (const std::string& path = options.overlay; !path.empty()) {
    const auto codec = options.overlay_codec == "h264" ? OverlayCodec::h264 : OverlayCodec::mpeg4;
    pictures_.push_back(video_for(path, "--overlay").overlay_video(path, frame_rate, codec, warn));
  }
  if (const std::string& path = options.picture; !path.empty()) {
    pictures_.push_back(video_for(path, "--picture").overlay_picture(path));
  }
}

void TrackOutputs::take(const ScanResult& result) {
  // A tracker names its modes at its first step, which lies behind; from then on they stand still.
  for (Track& track : tracks_) {
    track.file.write(result.reported[track.tracker],
                     scheduler_.logs()[track.tracker]->mode_names());
    if (keep_ > 0) track.file.forget(result.scan.frame - keep_ + 1);
  }
  for (const auto& picture : pictures_) picture->take(result);
}

void TrackOutputs::finish() {
  std::exception_ptr first;
  const auto attempt = [&first](const auto& work) {
    try {
      work();
    } catch (...) {
      if (!first) first = std::current_exception();
    }
  };
  for (Track& track : tracks_) {
    attempt([&] {
      track.file.close(*scheduler_.logs()[track.tracker], notes(scheduler_, track.tracker));
    });
  }
  for (const auto& picture : pictures_) attempt([&] { picture->finish(); });
  if (first) std::rethrow_exception(first);
}

std::vector<std::string> TrackOutputs::paths() const {
  std::vector<std::string> paths;
  for (const Track& track : tracks_) {
    for (std::string& path : track.file.paths()) paths.push_back(std::move(path));
  }
  for (const auto& picture : pictures_) paths.push_back(picture->path());
  return paths;
}

std::vector<std::string> notes(const Scheduler& scheduler, std::size_t i) {
  std::vector<std::string> all = scheduler.preparer().notes();
  for (std::string& note : scheduler.tracker(i).notes()) all.push_back(std::move(note));
  return all;
}

}  // namespace glint::cli
