/* SPDX-License-Identifier: Apache-2.0
 *
 * Tracks 16-bit grey frames in several goes, each a process of its own: goes on from STATE if that
 * file is there, prints the tracks of the frames on standard input, and leaves STATE for the next.
 *
 *     head -c 65536000 frames | ./resume_raw 640 512 mm-phd STATE
 *     tail -c +65536001 frames | ./resume_raw 640 512 mm-phd STATE
 */
#include <glint.h>
#include <stdio.h>
#include <stdlib.h>

static int fail(const char *what) {
  fprintf(stderr, "%s: %s\n", what, glint_last_error());
  return 1;
}

/* The file's bytes, to be freed; NULL if there is no such file. */
static void *read_file(const char *path, size_t *size) {
  FILE *file = fopen(path, "rb");
  void *bytes = NULL;
  if (file == NULL) return NULL;
  if (fseek(file, 0, SEEK_END) == 0 && ftell(file) > 0) {
    *size = (size_t)ftell(file);
    bytes = malloc(*size);
    rewind(file);
    if (bytes != NULL && fread(bytes, 1, *size, file) != *size) *size = 0;
  }
  fclose(file);
  return bytes;
}

/* A new engine, or one that goes on. */
static glint_status open_engine(const glint_options *options, const char *path,
                                glint_engine **engine) {
  size_t size = 0;
  void *state = read_file(path, &size);
  const glint_status status =
      state == NULL ? glint_create(options, engine) : glint_restore(options, state, size, engine);
  free(state);
  return status;
}

static int save(glint_engine *engine, const char *path) {
  void *state;
  size_t size, written = 0;
  FILE *file;
  if (glint_checkpoint(engine, &state, &size) != GLINT_OK) return fail("checkpoint");
  file = fopen(path, "wb");
  if (file != NULL) {
    written = fwrite(state, 1, size, file);
    if (fclose(file) != 0) written = 0;
  }
  glint_free(state);
  if (written == size) return 0;
  fprintf(stderr, "cannot write %s\n", path);
  return 1;
}

static void print_results(glint_engine *engine) {
  static glint_track tracks[1000];
  glint_result result = GLINT_RESULT_INIT;
  while (glint_poll(engine, &result, tracks, 1000) == GLINT_OK) {
    size_t i;
    for (i = 0; i < result.tracks; ++i) {
      printf("%lld %lld %.17g %.17g\n", (long long)tracks[i].frame, (long long)tracks[i].track_id,
             tracks[i].x, tracks[i].y);
    }
  }
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
  if (open_engine(&options, argv[4], &engine) != GLINT_OK) return fail(argv[4]);

  bytes = (size_t)frame.width * (size_t)frame.height * 2;
  pixels = malloc(bytes);
  frame.data = pixels;
  glint_counts(engine, &pushed, NULL);
  while (pixels != NULL && fread(pixels, 1, bytes, stdin) == bytes) {
    frame.time = (double)pushed++;
    if (glint_push(engine, &frame) != GLINT_OK) break;
  }
  if (glint_drain(engine) != GLINT_OK) return fail("track");
  print_results(engine);
  result = save(engine, argv[4]);
  free(pixels);
  glint_destroy(engine);
  return result;
}
