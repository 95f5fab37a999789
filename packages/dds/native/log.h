/*
 * Writes CycloneDDS's log to standard error, but at most one line every few seconds: otherwise anybody could flood the
 * log by sending malformed packets.
 */
#ifndef FARPOINT_LOG_H
#define FARPOINT_LOG_H

#include <stddef.h>

/* Call it once; further calls do no harm. */
void log_install(void);

/* The last line without its line end; empty if there was none since the last call. */
void log_take(char *to, size_t room);

#endif
