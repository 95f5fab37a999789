#include "decode.h"

#include <math.h>
#include <string.h>

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "the layouts are little-endian, and so is every machine this is built for"
#endif

enum { BLOCK_POINTS = 150, LATENCY_COLOUR = 0x03f0 };

/* Channel values at the centre of each step, as 0xAABBGGRR. */
static inline uint32_t colour_of(uint16_t packed) {
  const uint32_t red = (uint32_t)(packed >> 10) * 4 + 2;
  const uint32_t green = (uint32_t)((packed >> 4) & 0x3f) * 4 + 2;
  const uint32_t blue = (uint32_t)(packed & 0xf) * 16 + 8;
  return red | green << 8 | blue << 16 | 0xff000000u;
}

static inline uint32_t bits_of(float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

/* Returns whether every colour is the latency test's. */
static bool unpack_block(const uint8_t *block, size_t points, uint32_t *to) {
  const uint8_t *colours = block + points * 6;
  uint32_t other = 0;
  for (size_t i = 0; i < points; i++) {
    int16_t xyz[3];
    uint16_t colour;
    memcpy(xyz, block + i * 6, sizeof xyz);
    memcpy(&colour, colours + i * 2, sizeof colour);
    for (int axis = 0; axis < 3; axis++) to[i * 4 + axis] = bits_of((float)xyz[axis] / 1000.0f);
    to[i * 4 + 3] = colour_of(colour);
    other |= (uint32_t)colour ^ LATENCY_COLOUR;
  }
  return other == 0;
}

static bool unpack_blocks(const uint8_t *from, size_t points, uint32_t *to) {
  bool green = points > 0;
  for (size_t done = 0; done < points; done += BLOCK_POINTS) {
    const size_t count = points - done < BLOCK_POINTS ? points - done : BLOCK_POINTS;
    if (!unpack_block(from + done * 8, count, to + done * 4)) green = false;
  }
  return green;
}

int64_t decode_points64(struct mapping *mapping, size_t offset, size_t bytes, uint32_t *to, bool *green) {
  int64_t at;
  GUARDED(mapping->base, mapping->bytes, at, *green = unpack_blocks(mapping->base + offset, bytes / 8, to));
  return at;
}

static void unproject(const uint8_t *base, const struct depth_frame *frame, uint32_t *to) {
  const uint8_t *depths = base + frame->depth;
  const uint8_t *colours = base + frame->colour;
  const float over_fx = 1.0f / frame->fx;
  const float over_fy = 1.0f / frame->fy;
  for (uint32_t v = 0; v < frame->height; v++) {
    const float slope_y = ((float)v - frame->cy) * over_fy;
    for (uint32_t u = 0; u < frame->width; u++) {
      const size_t pixel = (size_t)v * frame->width + u;
      float depth;
      if (frame->unit > 0.0f) {
        uint16_t raw;
        memcpy(&raw, depths + pixel * 2, sizeof raw);
        depth = (float)raw * frame->unit;
      } else {
        memcpy(&depth, depths + pixel * 4, sizeof depth);
      }
      /* Also false for NaN. */
      if (!(depth > 0.0f)) depth = NAN;
      to[pixel * 4] = bits_of(((float)u - frame->cx) * over_fx * depth);
      to[pixel * 4 + 1] = bits_of(slope_y * depth);
      to[pixel * 4 + 2] = bits_of(depth);
      memcpy(&to[pixel * 4 + 3], colours + pixel * 4, 4);
    }
  }
}

int64_t decode_depth(struct mapping *mapping, const struct depth_frame *frame, uint32_t *to) {
  int64_t at;
  GUARDED(mapping->base, mapping->bytes, at, unproject(mapping->base, frame, to));
  return at;
}
