/*
 * What CycloneDDS has to say: to standard error, but no more than a line each few seconds, as whoever sends it malformed
 * packets decides how much that is.
 */
#ifndef FARPOINT_LOG_H
#define FARPOINT_LOG_H

#include <stddef.h>

/* Once is enough; more do no harm. */
void log_install(void);

/* The last line, without its end, empty where there was none since the last call. */
void log_take(char *to, size_t room);

#endif
