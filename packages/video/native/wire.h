/* Messages on the standard input and output: u32 length of the payload, u8 type, payload; little-endian. */
#ifndef FARPOINT_WIRE_H
#define FARPOINT_WIRE_H

#include <glib.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { HEADER_BYTES = 5 };
/* A raw picture of 8192 x 8192 in four bytes a pixel has 256 MiB; nothing here is near that. */
enum { MOST_MESSAGE_BYTES = 128 * 1024 * 1024, MOST_CODED_BYTES = 32 * 1024 * 1024 };

enum { MESSAGE_OPEN = 1, MESSAGE_CONFIGURE = 2, MESSAGE_KEY_FRAME = 3, MESSAGE_FRAME = 4, MESSAGE_CODED = 5 };
enum { MESSAGE_ENCODED = 65, MESSAGE_STATE = 66, MESSAGE_ERROR = 67 };

/* Moves the messages away from the standard output, onto which plugins print: that becomes the standard error. */
void wire_init(void);

/* Ends all waiting, now and later: what reads finds the end, what writes is abandoned. Safe in a signal handler. */
void wire_close(void);

/* Reads exactly `size` bytes of the standard input. Returns false at its end, or after wire_close(). */
bool wire_read(void *to, size_t size);

/*
 * Writes a message whole. Waits for as long as the reader takes nothing: the thread of the encoder then waits, and
 * pictures are dropped before the encoder, where no other picture depends on them.
 */
void wire_write(uint8_t type, const void *head, size_t head_size, const void *body, size_t body_size);

void wire_write_json(uint8_t type, const GString *json);

uint16_t load_u16(const uint8_t *from);
uint32_t load_u32(const uint8_t *from);
uint64_t load_u64(const uint8_t *from);
void store_u16(uint8_t *to, uint16_t value);
void store_u32(uint8_t *to, uint32_t value);
void store_u64(uint8_t *to, uint64_t value);

#endif
