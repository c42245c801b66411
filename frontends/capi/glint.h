/* SPDX-License-Identifier: Apache-2.0
 *
 * Glint's C interface, C99: frames in, tracks out.
 *
 *     glint_options options = GLINT_OPTIONS_INIT;
 *     options.tracker = "mm-phd";
 *     glint_engine *engine;
 *     if (glint_create(&options, &engine) != GLINT_OK) puts(glint_last_error());
 *     for each frame:
 *       glint_push(engine, &frame);
 *       while (glint_poll(engine, &result, tracks, 100) == GLINT_OK) ...;
 *     glint_finish(engine);
 *     while (glint_poll(engine, &result, tracks, 100) == GLINT_OK) ...;   the last frames
 *     glint_destroy(engine);
 *
 * Frames are tracked on the engine's own threads. Every function but glint_destroy() may be called
 * from any thread. Structs that are passed in begin with their size, and arrays come with that of
 * an element, so that a program built with an older header goes on working: it gets the fields that
 * it knows. Nothing is thrown.
 */
#ifndef GLINT_H
#define GLINT_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define GLINT_API
#else
#define GLINT_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum glint_status {
  GLINT_OK = 0,
  GLINT_NOTHING = 1,      /* glint_poll(): no result by now */
  GLINT_DROPPED = 2,      /* glint_push(): done, and a frame that waited was dropped for it */
  GLINT_TOO_SMALL = 3,    /* the array is too small; the count needed was stored */
  GLINT_BAD_ARGUMENT = 4, /* a pointer, a size or a field; see glint_last_error() */
  GLINT_BAD_CONFIG = 5,   /* an unknown key, tracker or profile, a value out of range */
  GLINT_BAD_STATE = 6,    /* a frame or a checkpoint after glint_finish() */
  GLINT_FAILED = 7,       /* tracking failed: the engine has ended */
  GLINT_BAD_CHECKPOINT = 8, /* damaged, or of another version, config or kind of device */
  GLINT_END = 9             /* glint_next(): every frame's result was given */
} glint_status;

/* Of the library, for example "0.1.0". */
GLINT_API const char *glint_version(void);
/* What the last call of this thread that failed had to say, in a line, with the remedy. Lives until
 * the thread's next call. */
GLINT_API const char *glint_last_error(void);
/* Whether this build has "tracker.<name>", "device.<kind>", "pixel.gray8", "pixel.gray16",
 * "pixel.float32", "points", "measurements" or "start": 1 or 0. */
GLINT_API int glint_has(const char *what);
/* Every setting with its meaning, range and default, as TOML; 0 at the end. `size` holds the
 * bytes of `text` and gets those needed: GLINT_TOO_SMALL if there are fewer. */
GLINT_API glint_status glint_default_config(char *text, size_t *size);

typedef struct glint_engine glint_engine;

typedef enum glint_when_full {
  GLINT_WAIT = 0,       /* once its queue is full glint_push() waits for a quarter of it: no frame is lost */
  GLINT_DROP_OLDEST = 1 /* the frame that has waited longest is dropped */
} glint_when_full;

typedef struct glint_options {
  size_t struct_size;        /* sizeof(glint_options) */
  const char *tracker;       /* names, separated by spaces; NULL: run.tracker of `config` says it */
  const char *profile;       /* "P" or "L"; NULL: none */
  const char *config;        /* TOML text, as `glint config TRACKER` prints it; NULL: defaults */
  size_t queue;              /* frames that may wait; 0: 8 */
  glint_when_full when_full; /* what then */
} glint_options;
#define GLINT_OPTIONS_INIT {sizeof(glint_options), NULL, NULL, NULL, 0, GLINT_WAIT}

/* An engine that waits for frames. With frames.background_prime = N in `config` the first result comes
 * once N frames came. For a stream without an end set run.keep in `config`: it bounds
 * what is held for glint_revised(). */
GLINT_API glint_status glint_create(const glint_options *options, glint_engine **engine);
/* Frames that still wait are not tracked. NULL is allowed. */
GLINT_API void glint_destroy(glint_engine *engine);

typedef enum glint_pixel { GLINT_GRAY8 = 0, GLINT_GRAY16 = 1, GLINT_FLOAT32 = 2 } glint_pixel;

typedef struct glint_frame {
  size_t struct_size; /* sizeof(glint_frame) */
  const void *data;   /* the first row's first pixel */
  glint_pixel pixel;  /* in the machine's byte order */
  int32_t width, height, channels; /* channels: 1 grey, 3 BGR, 4 BGRA, interleaved */
  ptrdiff_t row_bytes;             /* from one row to the next; 0: rows have no gaps */
  double time;                     /* [s] */
  /* With release the pixels are not copied: they must stay as they are until release(user) is
   * called, on any thread. It is called exactly once if glint_push() returns GLINT_OK or
   * GLINT_DROPPED, and not otherwise. Rows that are not aligned to their pixels are copied all the
   * same. */
  void (*release)(void *user);
  void *user;
} glint_frame;
#define GLINT_FRAME_INIT {sizeof(glint_frame), NULL, GLINT_GRAY8, 0, 0, 1, 0, 0, NULL, NULL}

/* Queues a frame; all frames have one size. GLINT_FAILED if the engine has ended by an error. */
GLINT_API glint_status glint_push(glint_engine *engine, const glint_frame *frame);

typedef struct glint_point {
  float x, y;      /* [px] */
  float amplitude; /* NaN: not known */
} glint_point;

/* glint_push_measurements() with 7 digits instead of 16: enough for pixels, not for metres on a
 * map. */
GLINT_API glint_status glint_push_points(glint_engine *engine, const glint_point *points,
                                         size_t count, double time);

typedef struct glint_measurement {
  double x, y;      /* [px], or the unit of length that the points and the settings share */
  double amplitude; /* [sigma]; NaN: not known */
} glint_measurement;

/* Queues the points of a scan without a frame, for trackers of points; all pushes are of one kind.
 * `measurement_size` is sizeof(glint_measurement); `measurements` may be NULL if there are none. */
GLINT_API glint_status glint_push_measurements(glint_engine *engine,
                                               const glint_measurement *measurements,
                                               size_t measurement_size, size_t count, double time);

typedef struct glint_cue {
  size_t struct_size; /* sizeof(glint_cue) */
  double x, y;        /* [px] */
  double vx, vy;      /* [px/s]; NaN, both: not known */
  double sigma;       /* standard deviation of x and of y [px]; NaN: what the tracker takes */
} glint_cue;
#define GLINT_CUE_INIT {sizeof(glint_cue), 0, 0, NAN, NAN, NAN}

/* Somebody's word for a target in the frame that is pushed next: every tracker starts a confirmed
 * track there. A target that has a track gets no second one, and outside the frame none starts.
 * Before the first frame a velocity does not count. GLINT_BAD_ARGUMENT for numbers that cannot be,
 * GLINT_BAD_STATE after glint_finish(). */
GLINT_API glint_status glint_start(glint_engine *engine, const glint_cue *cue);

typedef enum glint_track_status {
  GLINT_TENTATIVE = 0,
  GLINT_CONFIRMED = 1,
  GLINT_HALTED = 2
} glint_track_status;

typedef struct glint_track {
  int64_t frame;    /* number of its push, from 0 */
  double time;      /* [s] */
  int64_t track_id; /* of its tracker */
  int32_t tracker;  /* index among the trackers, in their order */
  int32_t status;   /* glint_track_status */
  double x, y;      /* [px]; (0, 0) is the centre of the first pixel */
  double vx, vy;    /* [px/s]; NaN where not known, as all that follows */
  double intensity, existence;
  double var_x, cov_xy, var_y; /* [px^2] */
  double cov_x_vx, cov_x_vy, cov_y_vx, cov_y_vy; /* [px^2/s] */
  double var_vx, cov_vx_vy, var_vy;              /* [px^2/s^2] */
} glint_track;

typedef struct glint_result {
  size_t struct_size; /* sizeof(glint_result) */
  size_t track_size;  /* sizeof(glint_track) */
  int64_t frame;
  double time;    /* [s] */
  double latency; /* from the push to the result [s] */
  size_t tracks;  /* how many */
} glint_result;
#define GLINT_RESULT_INIT {sizeof(glint_result), sizeof(glint_track), 0, 0, 0, 0}

/* The tracks of the next frame that is done, in order: GLINT_NOTHING if there is none by now.
 * `tracks` has room for `capacity`; if they are more, result->tracks says how many, and the result
 * stays to be asked for again. */
GLINT_API glint_status glint_poll(glint_engine *engine, glint_result *result, glint_track *tracks,
                                  size_t capacity);
/* The same, waited for at most `timeout` [s]; GLINT_END once glint_finish() was called and the last
 * frame's result was given. */
GLINT_API glint_status glint_next(glint_engine *engine, double timeout, glint_result *result,
                                  glint_track *tracks, size_t capacity);
/* Waits until every frame that was pushed is done. */
GLINT_API glint_status glint_drain(glint_engine *engine);
/* Drains, and lets the trackers report what they hold back. No frame can be pushed after that. */
GLINT_API glint_status glint_finish(glint_engine *engine);
/* After glint_finish(): all tracks of all frames as they were revised later, by tracker, frame and
 * track. `count` holds the room in `tracks`, `track_size` bytes each, and gets the number. */
GLINT_API glint_status glint_revised(glint_engine *engine, glint_track *tracks, size_t track_size,
                                     size_t *count);
/* Frames pushed, and those of them that were dropped. Either may be NULL. */
GLINT_API glint_status glint_counts(glint_engine *engine, int64_t *pushed, int64_t *dropped);

/* All that later frames depend on, and the tracks so far, as bytes. Frames that were pushed are
 * tracked first, and a glint_push() meanwhile waits; results that wait to be polled come along.
 * `*data` gets memory to be freed by glint_free(), `*size` its bytes; NULL and 0 on failure. */
GLINT_API glint_status glint_checkpoint(glint_engine *engine, void **data, size_t *size);
/* NULL is allowed. */
GLINT_API void glint_free(void *data);
/* Like glint_create(), but the engine goes on where that of the checkpoint was, in any process: the
 * tracks are the same, byte by byte, as if it had never stopped. The next frame is the one after
 * the last that was pushed. `options` name the same trackers and config (but for run.threads, queue
 * and when_full), the library has the same version, and run.device is of the same kind:
 * GLINT_BAD_CHECKPOINT otherwise, as for damaged bytes, and glint_last_error() says what differs.
 * Keep checkpoints like a program's own files: nobody can tell a forged number from a true one. */
GLINT_API glint_status glint_restore(const glint_options *options, const void *data, size_t size,
                                     glint_engine **engine);

#ifdef __cplusplus
}
#endif
#endif
