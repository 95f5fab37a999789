/* What pictures the camera has: YUYV at 640 × 480 and 320 × 240 and JPEG at 640 × 480, at 30 and 15 pictures/s. */
#include "formats.h"

#include <errno.h>
#include <stdbool.h>
#include <string.h>

static int none(void) {
  errno = EINVAL;
  return -1;
}

/* As a driver does: the nearest that it has. */
void settle(struct v4l2_pix_format *shape) {
  const bool jpeg = shape->pixelformat == V4L2_PIX_FMT_MJPEG;
  const bool large = jpeg || shape->width * shape->height > 480 * 360;
  shape->pixelformat = jpeg ? V4L2_PIX_FMT_MJPEG : V4L2_PIX_FMT_YUYV;
  shape->width = large ? 640 : 320;
  shape->height = large ? 480 : 240;
  shape->bytesperline = jpeg ? 0 : shape->width * 2;
  shape->sizeimage = shape->width * shape->height * 2;
  shape->field = V4L2_FIELD_NONE;
  shape->colorspace = V4L2_COLORSPACE_SRGB;
  shape->priv = 0;
}

int describe_format(struct v4l2_fmtdesc *format) {
  static const unsigned formats[] = {V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_MJPEG};
  if (format->index >= 2) return none();
  format->pixelformat = formats[format->index];
  format->flags = format->index == 1 ? V4L2_FMT_FLAG_COMPRESSED : 0;
  strcpy((char *)format->description, format->index == 0 ? "YUYV 4:2:2" : "Motion-JPEG");
  return 0;
}

int describe_size(struct v4l2_frmsizeenum *size) {
  if (size->index >= (size->pixel_format == V4L2_PIX_FMT_YUYV ? 2 : 1)) return none();
  size->type = V4L2_FRMSIZE_TYPE_DISCRETE;
  size->discrete.width = size->index == 0 ? 640 : 320;
  size->discrete.height = size->index == 0 ? 480 : 240;
  return 0;
}

int describe_interval(struct v4l2_frmivalenum *interval) {
  if (interval->index >= 2) return none();
  interval->type = V4L2_FRMIVAL_TYPE_DISCRETE;
  interval->discrete.numerator = 1;
  interval->discrete.denominator = interval->index == 0 ? 30 : 15;
  return 0;
}
