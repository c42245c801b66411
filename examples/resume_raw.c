/* SPDX-License-Identifier: Apache-2.0
 *
 * Tracks 16-bit grey frames in several goes, each a process of its own: goes on from STATE if that
 * file is there, prints the tracks of the frames on standard input, and leaves STATE for the next.
 *
 *     head -c 65536000 frames | ./resume_raw 640 512 mm-phd STATE
 *     tail -c +65536001 frames | ./resume_raw 640 512 mm-phd STATE
 */
#include <errno.h>
#include <glint.h>
#include <stdio.h>
#include <stdlib.h>

static int fail(const char *what) {
  fprintf(stderr, "%s: %s\n", what, glint_last_error());
  return 1;
}

/* The file's bytes, to be freed; NULL if they cannot be read. */
static void *read_all(FILE *file, size_t *size) {
  void *bytes = NULL;
  long length;
  if (fseek(file, 0, SEEK_END) != 0 || (length = ftell(file)) < 0) return NULL;
  rewind(file);
  bytes = malloc((size_t)length + 1); /* an empty file is no state, and is told so */
  if (bytes == NULL) return NULL;
  *size = fread(bytes, 1, (size_t)length, file);
  if (*size == (size_t)length) return bytes;
  free(bytes);
  return NULL;
}

/* A new engine if there is no such file, or one that goes on; NULL on failure. */
static glint_engine *open_engine(const glint_options *options, const char *path) {
  glint_engine *engine = NULL;
  FILE *file = fopen(path, "rb");
  void *state;
  size_t size = 0;
  if (file == NULL && errno == ENOENT) {
    if (glint_create(options, &engine) != GLINT_OK) fail("create");
    return engine;
  }
  state = file == NULL ? NULL : read_all(file, &size);
  if (file != NULL) fclose(file);
  if (state == NULL) {
    fprintf(stderr, "cannot read %s\n", path);
    return NULL;
  }
  if (glint_restore(options, state, size, &engine) != GLINT_OK) fail(path);
  free(state);
  return engine;
}

/* Under another name first: whenever this is cut off, a whole state is there. */
static int save(glint_engine *engine, const char *path) {
  char fresh[4096];
  void *state;
  size_t size, written = 0;
  FILE *file;
  if (glint_checkpoint(engine, &state, &size) != GLINT_OK) return fail("checkpoint");
  if (snprintf(fresh, sizeof fresh, "%s.new", path) >= (int)sizeof fresh) {
    fprintf(stderr, "%s is too long a name\n", path);
    glint_free(state);
    return 1;
  }
  file = fopen(fresh, "wb");
  if (file != NULL) {
    written = fwrite(state, 1, size, file);
    if (fclose(file) != 0) written = 0;
  }
  glint_free(state);
  if (written == size && rename(fresh, path) == 0) return 0;
  fprintf(stderr, "cannot write %s\n", fresh);
  return 1;
}

static glint_status print_results(glint_engine *engine) {
  static glint_track tracks[1000];
  glint_result result = GLINT_RESULT_INIT;
  glint_status status;
  while ((status = glint_poll(engine, &result, tracks, 1000)) == GLINT_OK) {
    size_t i;
    for (i = 0; i < result.tracks; ++i) {
      printf("%lld %lld %.17g %.17g\n", (long long)tracks[i].frame, (long long)tracks[i].track_id,
             tracks[i].x, tracks[i].y);
    }
  }
  return status;
}

int main(int argc, char **argv) {
  glint_options options = GLINT_OPTIONS_INIT;
  glint_frame frame = GLINT_FRAME_INIT;
  glint_engine *engine;
  int64_t pushed = 0;
  size_t bytes;
  void *pixels;
  int result;

  if (argc != 5) {
    fprintf(stderr, "usage: %s WIDTH HEIGHT TRACKER STATE < frames\n", argv[0]);
    return 2;
  }
  frame.width = atoi(argv[1]);
  frame.height = atoi(argv[2]);
  frame.pixel = GLINT_GRAY16;
  if (frame.width <= 0 || frame.height <= 0) {
    fprintf(stderr, "WIDTH and HEIGHT must be above 0\n");
    return 2;
  }
  options.tracker = argv[3];
  engine = open_engine(&options, argv[4]);
  if (engine == NULL) return 1;

  bytes = (size_t)frame.width * (size_t)frame.height * 2;
  pixels = malloc(bytes);
  frame.data = pixels;
  glint_counts(engine, &pushed, NULL);
  while (pixels != NULL && fread(pixels, 1, bytes, stdin) == bytes) {
    frame.time = (double)pushed++;
    if (glint_push(engine, &frame) != GLINT_OK) break;
  }
  if (glint_drain(engine) != GLINT_OK) return fail("track");
  if (print_results(engine) != GLINT_NOTHING) return fail("poll");
  result = save(engine, argv[4]);
  free(pixels);
  glint_destroy(engine);
  return result;
}
