/* From the bytes in a mapping to points of 16 bytes (x, y, z as float32 metres, then R, G, B, A), in one pass. */
#ifndef FARPOINT_DECODE_H
#define FARPOINT_DECODE_H

#include <stdbool.h>
#include <stdint.h>

#include "mapping.h"

/*
 * The reference system's packed points: blocks of 150, each 150 x (x, y, z as int16 millimetres) and then 150 x 16-bit
 * colour; the last block may be shorter. `bytes` is a multiple of 8. `*green`: every point has the latency test's colour.
 */
int64_t decode_points64(struct mapping *mapping, size_t offset, size_t bytes, uint32_t *to, bool *green);

struct depth_frame {
  /* Offsets in the mapping. */
  size_t depth;
  size_t colour;
  uint32_t width;
  uint32_t height;
  /* Metres a unit for 16-bit depth; 0 where the depth is float32 metres. */
  float unit;
  float fx, fy, cx, cy;
};

/* Unprojects depth by the pinhole model; what has no depth becomes NaN. */
int64_t decode_depth(struct mapping *mapping, const struct depth_frame *frame, uint32_t *to);

#endif
