// SPDX-License-Identifier: Apache-2.0
// The middle values of samples 0 .. n - 1 by bisection on their keys, without moving any. The
// including file has key_of_sample(), kNoKey for one to leave out, and whole(), the sum over the
// invocations that share the samples: those of number `part` look at part, part + parts, ...
uint key_of_sample(int i);
int whole(int count);

struct Samples {
  int n, part, parts;
  int bits;  // of a key
};

int known(Samples s) {
  int count = 0;
  for (int i = s.part; i < s.n; i += s.parts) count += key_of_sample(i) != kNoKey ? 1 : 0;
  return whole(count);
}

// The key that `rank` samples come before: bit by bit from the top, the largest key that no more
// samples lie below.
uint key_of_rank(Samples s, int rank) {
  uint key = 0u;
  for (int bit = s.bits - 1; bit >= 0; --bit) {
    uint candidate = key | (1u << bit);
    int below = 0;
    for (int i = s.part; i < s.n; i += s.parts) below += key_of_sample(i) < candidate ? 1 : 0;
    if (whole(below) <= rank) key = candidate;
  }
  return key;
}
