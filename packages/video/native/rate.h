/* The element `farpointrate`: lets through as many pictures a second as are wanted. It holds none back. */
#ifndef FARPOINT_RATE_H
#define FARPOINT_RATE_H

#include <gst/base/gstbasetransform.h>
#include <stdbool.h>

G_DECLARE_FINAL_TYPE(FarpointRate, farpoint_rate, FARPOINT, RATE, GstBaseTransform)

bool farpoint_rate_register(void);

/* Frames in 1000 s; 0 is the source's rate. Takes effect with the next picture, by new caps. */
void farpoint_rate_want(FarpointRate *rate, guint per_1000_s);

/* Pictures that came, and those of them that were left out for the rate. */
void farpoint_rate_counts(FarpointRate *rate, guint64 *came, guint64 *skipped);

#endif
