/* SPDX-License-Identifier: Apache-2.0 */
#include <glint.h>
#include <stdio.h>
#include <string.h>

/* Sends one empty frame through a tracker. */
int main(void) {
  static const uint8_t pixels[48 * 64];
  glint_options options = GLINT_OPTIONS_INIT;
  glint_frame frame = GLINT_FRAME_INIT;
  glint_result result = GLINT_RESULT_INIT;
  glint_engine *engine;
  options.tracker = "smc-phd";
  frame.data = pixels, frame.width = 64, frame.height = 48;
  if (glint_create(&options, &engine) != GLINT_OK || glint_push(engine, &frame) != GLINT_OK ||
      glint_drain(engine) != GLINT_OK || glint_poll(engine, &result, NULL, 0) != GLINT_OK) {
    puts(glint_last_error());
    return 1;
  }
  glint_destroy(engine);
  printf("glint %s, frame %d has %d tracks\n", glint_version(), (int)result.frame,
         (int)result.tracks);
  return result.tracks == 0 && strlen(glint_version()) > 0 ? 0 : 1;
}
