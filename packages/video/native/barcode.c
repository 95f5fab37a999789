/* The latency barcode: docs/protocol.md has its layout, packages/protocol draws and reads the same one. */
#include <string.h>
#include <time.h>

#include "video.h"

enum { SQUARE = 8, COLUMNS = 18, ROWS = 7, WIDTH = COLUMNS * SQUARE, HEIGHT = ROWS * SQUARE };
enum { BLACK = 16, WHITE = 235, NO_COLOUR = 128 };

/* CRC-16/CCITT-FALSE of the time, big-endian. */
static guint16 checksum(guint64 time) {
  guint16 crc = 0xffff;
  for (int bit = 63; bit >= 0; bit--) {
    const bool carry = (((time >> bit) & 1) ^ (crc >> 15)) != 0;
    crc = (guint16)(crc << 1 ^ (carry ? 0x1021 : 0));
  }
  return crc;
}

static bool is_white(int column, int row, const guint16 words[5]) {
  if (column == 0 || row == 0 || column == COLUMNS - 1 || row == ROWS - 1) return (column + row) % 2 == 0;
  return ((words[row - 1] >> (COLUMNS - 2 - column)) & 1) != 0;
}

/* Draws into the top-left corner of an I420 or NV12 picture, if there is room. */
static void draw(GstVideoFrame *frame, guint64 time) {
  if (GST_VIDEO_FRAME_WIDTH(frame) < WIDTH || GST_VIDEO_FRAME_HEIGHT(frame) < HEIGHT) return;
  const guint16 words[5] = {(guint16)(time >> 48), (guint16)(time >> 32), (guint16)(time >> 16), (guint16)time,
                            checksum(time)};
  const int stride = GST_VIDEO_FRAME_PLANE_STRIDE(frame, 0);
  for (int y = 0; y < HEIGHT; y++) {
    guint8 *line = (guint8 *)GST_VIDEO_FRAME_PLANE_DATA(frame, 0) + y * stride;
    for (int column = 0; column < COLUMNS; column++)
      memset(line + column * SQUARE, is_white(column, y / SQUARE, words) ? WHITE : BLACK, SQUARE);
  }
  const guint planes = GST_VIDEO_FRAME_N_PLANES(frame);
  for (guint plane = 1; plane < planes; plane++) {
    /* Half as many columns in each of two planes, or in pairs in one. */
    const size_t bytes = planes == 2 ? WIDTH : WIDTH / 2;
    for (int y = 0; y < HEIGHT / 2; y++)
      memset((guint8 *)GST_VIDEO_FRAME_PLANE_DATA(frame, plane) + y * GST_VIDEO_FRAME_PLANE_STRIDE(frame, plane),
             NO_COLOUR, bytes);
  }
}

static guint64 nanoseconds(clockid_t clock) {
  struct timespec time;
  clock_gettime(clock, &time);
  return (guint64)time.tv_sec * GST_SECOND + (guint64)time.tv_nsec;
}

static GstPadProbeReturn on_picture(GstPad *pad, GstPadProbeInfo *info, gpointer data) {
  Video *video = data;
  g_mutex_lock(&video->lock);
  const Barcode barcode = video->settings.barcode;
  g_mutex_unlock(&video->lock);
  if (barcode == BARCODE_NONE) return GST_PAD_PROBE_OK;
  GstCaps *caps = gst_pad_get_current_caps(pad);
  GstVideoInfo shape;
  const bool known = caps != NULL && gst_video_info_from_caps(&shape, caps);
  gst_clear_caps(&caps);
  if (!known) return GST_PAD_PROBE_OK;
  GstBuffer *buffer = gst_buffer_make_writable(GST_PAD_PROBE_INFO_BUFFER(info));
  GST_PAD_PROBE_INFO_DATA(info) = buffer;
  guint64 time = capture_time_at(video, pad, buffer);
  if (barcode == BARCODE_UNIX) time += nanoseconds(CLOCK_REALTIME) - nanoseconds(CLOCK_MONOTONIC);
  GstVideoFrame frame;
  if (gst_video_frame_map(&frame, &shape, buffer, GST_MAP_READWRITE)) {
    draw(&frame, time);
    gst_video_frame_unmap(&frame);
  }
  return GST_PAD_PROBE_OK;
}

void barcode_attach(Video *video) {
  GstPad *pad = gst_element_get_static_pad(video->size_filter, "src");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_picture, video, NULL);
  gst_object_unref(pad);
}
