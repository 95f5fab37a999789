/*
 * Converts the bytes in a mapping to a sampler's input, in one pass. Points have 16 bytes: x, y, z as float32 metres,
 * then R, G, B, A.
 */
#ifndef FARPOINT_DECODE_H
#define FARPOINT_DECODE_H

#include <stdbool.h>
#include <stdint.h>

#include "mapping.h"

/*
 * The reference system's packed points: blocks of 150, each 150 x (x, y, z as int16 millimetres) and then 150 x 16-bit
 * colour; the last block may be shorter. `bytes` is a multiple of 8. `*green`: every point has the latency test's
 * colour.
 */
int64_t decode_points64(struct mapping *mapping, size_t offset, size_t bytes, uint32_t *to, bool *green);

/* How the depth of each pixel is stored. */
enum depth_kind {
  /* In points of 16 bytes: z and then R, G, B, A are their last 8. */
  DEPTH_OF_POINTS,
  /* u16 in units; the colours are elsewhere. */
  DEPTH_16,
  /* float32 metres; the colours are elsewhere. */
  DEPTH_32,
};

struct depth_frame {
  enum depth_kind kind;
  size_t pixels;
  /* Offsets in the mapping; that of the colours is used for DEPTH_16 and DEPTH_32. */
  size_t depth;
  size_t colour;
  /* Metres per unit of DEPTH_16. */
  float unit;
};

/* Depth in metres along z, and R, G, B, A of each pixel. */
int64_t decode_images(struct mapping *mapping, const struct depth_frame *frame, float *depth, uint32_t *colour);

#endif
