/*
 * The writer of the reference system's command block, with its own dead man: a thread that writes zero velocity if
 * nothing has been written for a while, even if JavaScript hangs.
 */
#ifndef FARPOINT_CONTROL_H
#define FARPOINT_CONTROL_H

#include <stdint.h>

#include "mapping.h"

struct control;

enum { CONTROL_VALUES = 6, CONTROL_BYTES = 52 };

/* `block` has 52 bytes, `busy` at least 1; both are writable. NULL if no thread could be created. */
struct control *control_start(struct mapping *block, struct mapping *busy, uint32_t silence_ms);
/* Linear x, y, z and angular x, y, z. Returns -1, or the offset in the block at which the file ended. */
int64_t control_write(struct control *control, const double values[CONTROL_VALUES], int32_t *counter);
/* How often silence has set the velocity to zero. */
uint32_t control_silences(struct control *control);
/* Writes zero velocity and ends the thread. */
void control_stop(struct control *control);

#endif
