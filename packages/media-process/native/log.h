/* Logs as JSON lines on the standard error, and text for JSON messages. */
#ifndef FARPOINT_LOG_H
#define FARPOINT_LOG_H

#include <glib.h>

/* Takes over what GLib and GStreamer log. Call after gst_init(). */
void log_init(void);

void log_line(const char *level, const char *text);

/* Appends `text` as a JSON string; NULL is empty. */
void json_string(GString *to, const char *text);

#endif
