/* SPDX-License-Identifier: Apache-2.0
 *
 * Tracks 16-bit grey frames from standard input and prints confirmed tracks as they are known:
 *
 *     cc track_raw.c -lglint_c -o track_raw
 *     camera | ./track_raw 640 512 mm-phd
 */
#include <glint.h>
#include <stdio.h>
#include <stdlib.h>

static int fail(const char *what) {
  fprintf(stderr, "%s: %s\n", what, glint_last_error());
  return 1;
}

/* Prints what is known by now. */
static glint_status print_results(glint_engine *engine) {
  static glint_track tracks[1000];
  glint_result result = GLINT_RESULT_INIT;
  glint_status status;
  while ((status = glint_poll(engine, &result, tracks, 1000)) == GLINT_OK) {
    size_t i;
    for (i = 0; i < result.tracks; ++i) {
      if (tracks[i].status != GLINT_CONFIRMED) continue;
      printf("%lld %lld %.9g %.9g\n", (long long)tracks[i].frame, (long long)tracks[i].track_id,
             tracks[i].x, tracks[i].y);
    }
    fflush(stdout);
  }
  return status;
}

int main(int argc, char **argv) {
  glint_options options = GLINT_OPTIONS_INIT;
  glint_frame frame = GLINT_FRAME_INIT;
  glint_engine *engine;
  size_t bytes;
  void *pixels;
  int result = 0;

  if (argc != 4) {
    fprintf(stderr, "usage: %s WIDTH HEIGHT TRACKER < frames\n", argv[0]);
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
  options.config = "[run]\nkeep = 1000\n";
  if (glint_create(&options, &engine) != GLINT_OK) return fail("create");

  bytes = (size_t)frame.width * (size_t)frame.height * 2;
  pixels = malloc(bytes);
  frame.data = pixels;
  while (pixels != NULL && fread(pixels, 1, bytes, stdin) == bytes) {
    if (glint_push(engine, &frame) != GLINT_OK) break;
    frame.time += 1;
    print_results(engine);
  }
  if (glint_finish(engine) != GLINT_OK) result = fail("track");
  print_results(engine);
  free(pixels);
  glint_destroy(engine);
  return result;
}
