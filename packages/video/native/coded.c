/* What a coded picture says of itself in its first bytes. They come from outside: each is looked at before it is used. */
#include <string.h>

#include "video.h"
#include "wire.h"

static bool in_range(guint width, guint height) {
  return width > 0 && height > 0 && width <= MOST_SIDE && height <= MOST_SIDE;
}

static guint big_u16(const uint8_t *from) { return (guint)(from[0] << 8 | from[1]); }

/* A frame header (SOF), whatever its kind of coding; not DHT, JPG or DAC. */
static bool is_frame_header(uint8_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

static bool sound_jpeg(const uint8_t *bytes, gsize size) {
  if (size < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) return false;
  for (gsize at = 2; at + 9 <= size;) {
    if (bytes[at] != 0xff) return false;
    const uint8_t marker = bytes[at + 1];
    /* A fill byte, and markers without a length. */
    if (marker == 0xff) {
      at++;
      continue;
    }
    if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7)) {
      at += 2;
      continue;
    }
    if (is_frame_header(marker)) return in_range(big_u16(bytes + at + 7), big_u16(bytes + at + 5));
    const guint length = big_u16(bytes + at + 2);
    if (length < 2) return false;
    at += 2 + length;
  }
  return false;
}

static bool sound_png(const uint8_t *bytes, gsize size) {
  static const uint8_t begin[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R'};
  if (size < sizeof begin + 13 || memcmp(bytes, begin, sizeof begin) != 0) return false;
  /* Of sides that long, only the low halves are in use. */
  if (big_u16(bytes + 16) != 0 || big_u16(bytes + 20) != 0) return false;
  return in_range(big_u16(bytes + 18), big_u16(bytes + 22));
}

static bool is_vp8_key(const uint8_t *bytes, gsize size) { return size > 0 && (bytes[0] & 1) == 0; }

static bool sound_vp8(const uint8_t *bytes, gsize size) {
  if (size < 4) return false;
  if (!is_vp8_key(bytes, size)) return true;
  if (size < 10 || bytes[3] != 0x9d || bytes[4] != 0x01 || bytes[5] != 0x2a) return false;
  return in_range(load_u16(bytes + 6) & 0x3fff, load_u16(bytes + 8) & 0x3fff);
}

/* A bit for each type of NAL unit. */
static guint32 nal_types(const uint8_t *bytes, gsize size) {
  guint32 types = 0;
  for (gsize at = 0; at + 3 < size; at++) {
    const uint8_t *one = memchr(bytes + at, 1, size - at - 1);
    if (one == NULL) break;
    at = (gsize)(one - bytes);
    if (at >= 2 && bytes[at - 1] == 0 && bytes[at - 2] == 0) types |= 1u << (one[1] & 31);
  }
  return types;
}

bool coded_alone(Coding coding) { return coding == CODING_JPEG || coding == CODING_PNG; }

bool coded_sound(Coding coding, const uint8_t *bytes, gsize size) {
  switch (coding) {
    case CODING_JPEG: return sound_jpeg(bytes, size);
    case CODING_PNG: return sound_png(bytes, size);
    case CODING_VP8: return sound_vp8(bytes, size);
    case CODING_H264: return nal_types(bytes, size) != 0;
    default: return false;
  }
}

bool coded_key(Coding coding, const uint8_t *bytes, gsize size) {
  enum { IDR = 1u << 5, SEQUENCE = 1u << 7 };
  if (coding == CODING_VP8) return is_vp8_key(bytes, size);
  /* A sequence's parameters precede each picture where a decoder can begin, also one that is no IDR picture. */
  if (coding == CODING_H264) return (nal_types(bytes, size) & (IDR | SEQUENCE)) != 0;
  return true;
}
