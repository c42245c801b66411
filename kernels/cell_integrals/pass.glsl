// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: a band of a frame's rows, and targets by the windows that they have in the frame.
struct CellBand {
  int width;          // of the frame
  int first, last;    // rows that were sent
  uint items;         // that the pass runs over
  uint boxes;         // without data
  float threshold, offset;  // z = pixel - offset above the threshold
  uint truncate_dark;
  float background;   // pi_0 / S
  uint log_likelihood;
};
struct Window {
  int x0, y0, x1, y1;  // clipped to the frame
  float left, top;     // first edges, from the mean [px]
  float sigma_x, sigma_y, proportion;
  uint columns;  // place of its columns' integrals, of which rows' come next
  uint first_neighbour, end_neighbour;
};
struct WindowRow {
  uint target;
  int y;
};
struct RowRun {  // rows of one target
  uint target, first, end;
};
struct AxisCell {  // integrals over a cell of an axis
  float p, first, second;
};
struct RowSums {  // over a row of a window, with the columns' integrals
  float p, first, second;
  float missing_p, missing_first, missing_second;  // over cells without data
  float log_ratio;
};
struct WindowSums {
  double count, x, y, xx, yy;
  double missing, missing_x, missing_y, missing_xx, missing_yy;
  double log_ratio;
};
const int kSpan = 256;  // pixels of a row that one invocation sums
