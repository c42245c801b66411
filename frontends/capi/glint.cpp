// SPDX-License-Identifier: Apache-2.0
#include "glint/frontends/capi/glint.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "glint/engine/engine.hpp"
#include "glint/engine/profiles.hpp"
#include "glint/engine/run_config.hpp"
#include "glint/engine/trackers/registry.hpp"
#include "glint/frontends/capi/guard.hpp"
#include "glint/frontends/capi/pushed_frame.hpp"
#include "glint/frontends/capi/track_row.hpp"
#include "glint/frontends/config/toml.hpp"
#include "glint/frontends/usage_error.hpp"

using namespace glint;
using namespace glint::capi;

struct glint_engine {
  explicit glint_engine(Scheduler scheduler, const EngineSettings& settings)
      : engine(std::move(scheduler), settings) {}
  Engine engine;
  std::mutex mutex;
  bool finished = false;  // under mutex
};

namespace {

Scheduler scheduler_of(const glint_options& options) {
  std::vector<ConfigSection> sections = all_sections();
  if (options.profile != nullptr) apply_profile(options.profile, sections);
  if (options.config != nullptr) parse_toml(options.config, "config", sections);
  if (options.tracker != nullptr) {
    apply_set(std::string("run.tracker=") + options.tracker, sections);
  }
  if (trackers_of(section_named(sections, "run").as<RunConfig>()).empty()) {
    throw ConfigError("no tracker is named; set options.tracker, for example to \"mm-phd\"");
  }
  return pushed_frames_scheduler(sections);
}

/// An array of the caller's, whose elements may be older and shorter than ours.
class Tracks {
 public:
  Tracks(glint_track* first, std::size_t size)
      : to_(reinterpret_cast<std::byte*>(first)), size_(size) {
    require(size > 0, "track_size is 0: it must be sizeof(glint_track)");
  }
  void put(const TrackPoint& point, std::size_t tracker) {
    const glint_track track = track_of(point, tracker);
    std::memcpy(to_, &track, std::min(size_, sizeof(track)));
    to_ += size_;
  }

 private:
  std::byte* to_;
  std::size_t size_;
};

std::unique_ptr<glint_engine> created(const glint_options* options) {
  const glint_options all = taken(options, GLINT_OPTIONS_INIT, "options is NULL");
  EngineSettings settings;
  if (all.queue > 0) settings.queue = all.queue;
  require(all.when_full == GLINT_WAIT || all.when_full == GLINT_DROP_OLDEST,
          "when_full must be GLINT_WAIT or GLINT_DROP_OLDEST");
  if (all.when_full == GLINT_DROP_OLDEST) {
    settings.when_full = EngineSettings::WhenFull::drop_oldest;
  }
  try {
    return std::make_unique<glint_engine>(scheduler_of(all), settings);
  } catch (const std::invalid_argument& e) {  // of settings that do not go together
    throw UsageError(e.what());
  }
}

/// Waits at most `timeout` [s].
glint_status poll(glint_engine& handle, double timeout, glint_result& given, glint_track* tracks,
                  std::size_t capacity) {
  glint_result result = taken(&given, GLINT_RESULT_INIT, "");
  bool any = false;
  const auto fits = [&](const EngineResult& next) {
    any = true;
    result.frame = next.frame, result.time = next.time;
    result.latency = next.latency, result.tracks = next.tracks.size();
    return result.tracks <= capacity && (tracks != nullptr || result.tracks == 0);
  };
  const auto taken_out = handle.engine.poll(std::chrono::duration<double>(timeout), fits);
  if (!any) {
    if (handle.engine.more()) return GLINT_NOTHING;
    handle.engine.poll();  // throws if it has failed since
    return GLINT_END;
  }
  std::memcpy(&given, &result, std::min(given.struct_size, sizeof(result)));
  if (result.tracks > capacity) {
    last_error = "the frame has " + std::to_string(result.tracks) +
                 " tracks, and there is room for " + std::to_string(capacity) +
                 "; poll again with more";
    return GLINT_TOO_SMALL;
  }
  require(tracks != nullptr || result.tracks == 0, "tracks is NULL");
  Tracks out(tracks, result.track_size);
  for (const Track& track : taken_out->tracks) {
    out.put(track, static_cast<std::size_t>(track.tracker));
  }
  return GLINT_OK;
}

glint_status push(glint_engine* engine, std::vector<PointMeasurement> points, double time) {
  require(engine != nullptr, "engine is NULL");
  SourceFrame source;
  source.time = time, source.points = std::move(points);
  return engine->engine.push(std::move(source)) ? GLINT_OK : GLINT_DROPPED;
}

}  // namespace

const char* glint_version(void) { return library_version().data(); }

const char* glint_last_error(void) { return last_error.c_str(); }

int glint_has(const char* what) {
  if (what == nullptr) return 0;
  const std::string_view asked(what);
  constexpr std::string_view kTracker = "tracker.", kDevice = "device.";
  if (asked.starts_with(kTracker)) {
    return std::ranges::any_of(all_trackers(), [&](const TrackerEntry& t) {
      return t.name == asked.substr(kTracker.size());
    });
  }
  if (asked.starts_with(kDevice)) {
    return guarded([&] {
             Device::named(asked.substr(kDevice.size()));
             return GLINT_OK;
           }) == GLINT_OK;
  }
  constexpr std::array<std::string_view, 6> kOthers{"pixel.gray8", "pixel.gray16", "pixel.float32",
                                                    "points",      "measurements", "start"};
  return std::ranges::find(kOthers, asked) != kOthers.end();
}

glint_status glint_default_config(char* text, size_t* size) {
  return guarded([&] {
    require(size != nullptr, "size is NULL");
    const std::string toml = write_toml(all_sections());
    const std::size_t room = text == nullptr ? 0 : *size;
    *size = toml.size() + 1;
    if (room < *size) {
      last_error = "the text has " + std::to_string(*size) + " bytes";
      return GLINT_TOO_SMALL;
    }
    std::memcpy(text, toml.c_str(), *size);
    return GLINT_OK;
  });
}

glint_status glint_create(const glint_options* options, glint_engine** engine) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    *engine = nullptr;
    *engine = created(options).release();
    return GLINT_OK;
  });
}

void glint_destroy(glint_engine* engine) { delete engine; }

glint_status glint_push(glint_engine* engine, const glint_frame* frame) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    const glint_frame all = taken(frame, GLINT_FRAME_INIT, "frame is NULL");
    SourceFrame source = source_frame(all);
    const auto lease = std::make_shared<Lease>(all.release, all.user, std::move(source.owner));
    source.owner = lease;
    try {
      return engine->engine.push(std::move(source)) ? GLINT_OK : GLINT_DROPPED;
    } catch (...) {
      lease->keep();
      throw;
    }
  });
}

glint_status glint_push_points(glint_engine* engine, const glint_point* points, size_t count,
                               double time) {
  return guarded([&] {
    require(points != nullptr || count == 0, "points is NULL");
    std::vector<PointMeasurement> measurements;
    for (const glint_point& p : std::span(points, count)) {
      measurements.push_back(
          {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.amplitude)});
    }
    return push(engine, std::move(measurements), time);
  });
}

glint_status glint_push_measurements(glint_engine* engine, const glint_measurement* measurements,
                                     size_t measurement_size, size_t count, double time) {
  return guarded([&] {
    require(measurements != nullptr || count == 0, "measurements is NULL");
    require(measurement_size > 0, "measurement_size is 0: it must be sizeof(glint_measurement)");
    const auto* from = reinterpret_cast<const std::byte*>(measurements);
    std::vector<PointMeasurement> all;
    for (std::size_t i = 0; i < count; ++i, from += measurement_size) {
      glint_measurement m{0, 0, std::numeric_limits<double>::quiet_NaN()};
      std::memcpy(&m, from, std::min(measurement_size, sizeof(m)));
      all.push_back({m.x, m.y, m.amplitude});
    }
    return push(engine, std::move(all), time);
  });
}

glint_status glint_start(glint_engine* engine, const glint_cue* cue) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    const glint_cue all = taken(cue, GLINT_CUE_INIT, "cue is NULL");
    try {
      engine->engine.start(all.x, all.y, all.vx, all.vy, all.sigma);
    } catch (const std::invalid_argument& e) {
      throw BadArgument(e.what());
    }
    return GLINT_OK;
  });
}

glint_status glint_poll(glint_engine* engine, glint_result* result, glint_track* tracks,
                        size_t capacity) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    require(result != nullptr, "result is NULL");
    const glint_status status = poll(*engine, 0, *result, tracks, capacity);
    return status == GLINT_END ? GLINT_NOTHING : status;
  });
}

glint_status glint_next(glint_engine* engine, double timeout, glint_result* result,
                        glint_track* tracks, size_t capacity) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    require(result != nullptr, "result is NULL");
    return poll(*engine, timeout, *result, tracks, capacity);
  });
}

glint_status glint_drain(glint_engine* engine) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    engine->engine.drain();
    return GLINT_OK;
  });
}

glint_status glint_finish(glint_engine* engine) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    engine->engine.finish();
    const std::scoped_lock lock(engine->mutex);
    engine->finished = true;
    return GLINT_OK;
  });
}

glint_status glint_revised(glint_engine* engine, glint_track* tracks, size_t track_size,
                           size_t* count) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    require(count != nullptr, "count is NULL");
    {
      const std::scoped_lock lock(engine->mutex);
      if (!engine->finished) throw std::logic_error("call glint_finish() first");
    }
    std::vector<std::vector<TrackPoint>> revised;
    std::size_t needed = 0;
    for (const TrackLog* log : engine->engine.scheduler().logs()) {
      needed += revised.emplace_back(log->revised()).size();
    }
    const std::size_t room = tracks == nullptr ? 0 : *count;
    *count = needed;
    if (room < needed) {
      last_error = "there are " + std::to_string(needed) + " tracks";
      return GLINT_TOO_SMALL;
    }
    Tracks out(tracks, track_size);
    for (std::size_t i = 0; i < revised.size(); ++i) {
      for (const TrackPoint& p : revised[i]) out.put(p, i);
    }
    return GLINT_OK;
  });
}

glint_status glint_counts(glint_engine* engine, int64_t* pushed, int64_t* dropped) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    if (pushed != nullptr) *pushed = engine->engine.pushed();
    if (dropped != nullptr) *dropped = engine->engine.dropped();
    return GLINT_OK;
  });
}

glint_status glint_checkpoint(glint_engine* engine, void** data, size_t* size) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    require(data != nullptr && size != nullptr, "data or size is NULL");
    *data = nullptr, *size = 0;
    const std::string bytes = engine->engine.checkpoint();
    *data = std::malloc(bytes.size());
    if (*data == nullptr) throw std::bad_alloc();
    std::memcpy(*data, bytes.data(), bytes.size());
    *size = bytes.size();
    return GLINT_OK;
  });
}

void glint_free(void* data) { std::free(data); }

glint_status glint_restore(const glint_options* options, const void* data, size_t size,
                           glint_engine** engine) {
  return guarded([&] {
    require(engine != nullptr, "engine is NULL");
    *engine = nullptr;
    require(data != nullptr, "data is NULL");
    std::unique_ptr<glint_engine> made = created(options);
    made->engine.restore({static_cast<const char*>(data), size});
    *engine = made.release();
    return GLINT_OK;
  });
}
