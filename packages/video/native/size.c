#include "video.h"

enum { LEAST_SIDE = 16 };

/* An even number of pixels, because the pictures' colours have half the resolution. */
static guint even(double pixels, guint most) {
  guint result = 2 * (guint)(pixels / 2 + 0.5);
  if (most != 0) result = MIN(result, most & ~1u);
  return MAX(result, LEAST_SIDE);
}

/* The source's picture with square pixels, its proportions kept, made smaller where it exceeds the settings. */
void fit_size(const GstVideoInfo *source, const Settings *settings, guint *width, guint *height) {
  double w = GST_VIDEO_INFO_WIDTH(source), h = GST_VIDEO_INFO_HEIGHT(source);
  if (GST_VIDEO_INFO_PAR_N(source) > 0 && GST_VIDEO_INFO_PAR_D(source) > 0)
    w = w * GST_VIDEO_INFO_PAR_N(source) / GST_VIDEO_INFO_PAR_D(source);
  double scale = 1;
  if (settings->width != 0) scale = MIN(scale, settings->width / w);
  if (settings->height != 0) scale = MIN(scale, settings->height / h);
  *width = even(w * scale, settings->width);
  *height = even(h * scale, settings->height);
}
