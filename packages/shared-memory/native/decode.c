#include "decode.h"

#include <string.h>

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "the layouts are little-endian, and so is every machine this is built for"
#endif

enum { BLOCK_POINTS = 150, LATENCY_COLOUR = 0x03f0 };

/* Channel values at the centre of each quantisation step, as 0xAABBGGRR. */
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

static void split(const uint8_t *base, const struct depth_frame *frame, float *depth, uint32_t *colour) {
  const uint8_t *from = base + frame->depth;
  switch (frame->kind) {
    case DEPTH_OF_POINTS:
      for (size_t i = 0; i < frame->pixels; i++) {
        memcpy(&depth[i], from + i * 16 + 8, 4);
        memcpy(&colour[i], from + i * 16 + 12, 4);
      }
      return;
    case DEPTH_16:
      for (size_t i = 0; i < frame->pixels; i++) {
        uint16_t raw;
        memcpy(&raw, from + i * 2, sizeof raw);
        depth[i] = (float)raw * frame->unit;
      }
      break;
    case DEPTH_32:
      memcpy(depth, from, frame->pixels * 4);
      break;
  }
  memcpy(colour, base + frame->colour, frame->pixels * 4);
}

int64_t decode_images(struct mapping *mapping, const struct depth_frame *frame, float *depth, uint32_t *colour) {
  int64_t at;
  GUARDED(mapping->base, mapping->bytes, at, split(mapping->base, frame, depth, colour));
  return at;
}
