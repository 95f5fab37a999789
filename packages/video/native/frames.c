/* Raw pictures from the input, for a source that is an appsrc. */
#include <gst/app/gstappsrc.h>

#include "log.h"
#include "video.h"
#include "wire.h"

enum { HEAD_BYTES = 17 };

/* By the code in the message; wire.ts has the same list. */
static const GstVideoFormat formats[] = {
    GST_VIDEO_FORMAT_UNKNOWN, GST_VIDEO_FORMAT_I420, GST_VIDEO_FORMAT_NV12, GST_VIDEO_FORMAT_YUY2,
    GST_VIDEO_FORMAT_UYVY,    GST_VIDEO_FORMAT_RGB,  GST_VIDEO_FORMAT_BGR,  GST_VIDEO_FORMAT_RGBA,
    GST_VIDEO_FORMAT_BGRA,    GST_VIDEO_FORMAT_GRAY8};

typedef struct {
  guint64 capture;
  GstVideoFormat format;
  guint width, height, stride;
} Head;

/* The caps and the picture they belong to come from the input's thread, or from the decoder's. */
static GMutex push_lock;

static bool skip(guint32 size) {
  uint8_t scratch[4096];
  while (size > 0) {
    const guint32 step = MIN(size, sizeof scratch);
    if (!wire_read(scratch, step)) return false;
    size -= step;
  }
  return true;
}

bool frames_refuse(Video *video, guint32 size, const char *why) {
  if (g_atomic_int_add(&video->refused, 1) == 0) log_line("error", why);
  return skip(size);
}

/* Where each plane lies: one after the other, the chroma rows as long as the luma rows' bytes ask for. */
static gsize planes(const Head *head, const GstVideoInfo *info, gsize offset[GST_VIDEO_MAX_PLANES],
                    gint stride[GST_VIDEO_MAX_PLANES]) {
  gsize size = 0;
  for (guint plane = 0; plane < GST_VIDEO_INFO_N_PLANES(info); plane++) {
    const bool half = plane > 0;
    const guint rows = half ? (head->height + 1) / 2 : head->height;
    offset[plane] = size;
    stride[plane] = (gint)(half && head->format == GST_VIDEO_FORMAT_I420 ? (head->stride + 1) / 2 : head->stride);
    size += (gsize)stride[plane] * rows;
  }
  return size;
}

/* Bytes of the pixels in a row of the first plane. */
static guint row_bytes(const Head *head, const GstVideoInfo *info) {
  const guint pixels = head->format == GST_VIDEO_FORMAT_YUY2 || head->format == GST_VIDEO_FORMAT_UYVY ||
                               head->format == GST_VIDEO_FORMAT_NV12
                           ? (head->width + 1) & ~1u
                           : head->width;
  return pixels * (guint)GST_VIDEO_INFO_COMP_PSTRIDE(info, 0);
}

void frames_push(Video *video, GstBuffer *buffer, GstCaps *caps) {
  g_mutex_lock(&push_lock);
  gst_app_src_set_caps(GST_APP_SRC(video->frames), caps);
  gst_app_src_push_buffer(GST_APP_SRC(video->frames), buffer);
  g_mutex_unlock(&push_lock);
}

bool frames_take(Video *video, guint32 size) {
  uint8_t bytes[HEAD_BYTES];
  if (size < HEAD_BYTES) return frames_refuse(video, size, "a raw picture's message is too short");
  if (!wire_read(bytes, sizeof bytes)) return false;
  const guint32 rest = size - HEAD_BYTES;
  const Head head = {.capture = load_u64(bytes),
                     .format = bytes[8] < G_N_ELEMENTS(formats) ? formats[bytes[8]] : GST_VIDEO_FORMAT_UNKNOWN,
                     .width = load_u16(bytes + 9),
                     .height = load_u16(bytes + 11),
                     .stride = load_u32(bytes + 13)};
  if (video->frames == NULL) return frames_refuse(video, rest, "a raw picture came, but the source is another one");
  if (head.format == GST_VIDEO_FORMAT_UNKNOWN) return frames_refuse(video, rest, "a raw picture's format is unknown");
  if (head.width == 0 || head.height == 0 || head.width > MOST_SIDE || head.height > MOST_SIDE)
    return frames_refuse(video, rest, "a raw picture's size is out of range");
  GstVideoInfo info;
  gst_video_info_set_format(&info, head.format, head.width, head.height);
  gsize offset[GST_VIDEO_MAX_PLANES] = {0};
  gint stride[GST_VIDEO_MAX_PLANES] = {0};
  if (head.stride < row_bytes(&head, &info) || head.stride > 16 * MOST_SIDE)
    return frames_refuse(video, rest, "a raw picture's rows are too short");
  if (planes(&head, &info, offset, stride) != rest)
    return frames_refuse(video, rest, "a raw picture has another number of bytes than its size and stride say");

  GstBuffer *buffer = gst_buffer_new_allocate(NULL, rest, NULL);
  GstMapInfo map;
  gst_buffer_map(buffer, &map, GST_MAP_WRITE);
  const bool complete = wire_read(map.data, rest);
  gst_buffer_unmap(buffer, &map);
  if (!complete) {
    gst_buffer_unref(buffer);
    return false;
  }
  gst_buffer_add_video_meta_full(buffer, GST_VIDEO_FRAME_FLAG_NONE, head.format, head.width, head.height,
                                 GST_VIDEO_INFO_N_PLANES(&info), offset, stride);
  /* The pipeline's base time is 0: its running time is CLOCK_MONOTONIC. */
  GST_BUFFER_PTS(buffer) = head.capture;
  GstCaps *caps = gst_video_info_to_caps(&info);
  frames_push(video, buffer, caps);
  gst_caps_unref(caps);
  return true;
}
