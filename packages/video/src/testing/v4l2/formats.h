/* What pictures the camera has: see formats.c. */
#pragma once
#include <linux/videodev2.h>

void settle(struct v4l2_pix_format *shape);
/* They return -1 past the last one. */
int describe_format(struct v4l2_fmtdesc *format);
int describe_size(struct v4l2_frmsizeenum *size);
int describe_interval(struct v4l2_frmivalenum *interval);
