/* Why a program cannot go on, and its end. */
#ifndef FARPOINT_FAULT_H
#define FARPOINT_FAULT_H

#include <gst/gst.h>
#include <stdbool.h>

/* What holds on to a device or a server is given this long when the program ends. */
enum { STOP_S = 2 };

/* Ends all waiting on SIGTERM and SIGINT; the program itself after STOP_S more. */
void handle_signals(void);

/* Says why nothing comes any more, once, and ends the loop. `said` is in GStreamer's own words. */
void fault_tell(GMainLoop *loop, const char *reason, const char *said, const char *detail);

bool has_failed(void);

/* Whether two elements found no common format. */
bool fault_is_not_negotiated(GstMessage *message, const GError *error);

/* Whether an element that is needed is not installed. */
bool fault_is_missing_element(const GError *error);

/* By the loop itself, because it may not run yet. */
void end_soon(GMainLoop *loop);

#endif
