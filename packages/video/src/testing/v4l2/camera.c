/*
 * A camera on USB, for tests on machines without one: loaded before a program (LD_PRELOAD), it answers what that program
 * asks of /dev/farpoint-camera, as a driver of the kernel would (V4L2, linux/videodev2.h). It is strict: what the
 * interface forbids is refused, and said on stderr.
 *
 * YUYV pictures are grey; their level counts pictures. FARPOINT_CAMERA_JPEG is the file with the JPEG picture. While the file FARPOINT_CAMERA_UNPLUGGED
 * exists, the camera is gone. FARPOINT_CAMERA_LOG gets a line for each picture: its level, and when it was taken, ns of
 * CLOCK_MONOTONIC; and the line "stream" whenever the program begins a stream. The device is a timer, which poll() can wait
 * for; each expiry is a picture.
 */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

#include "camera.h"
#include "formats.h"

enum { BUFFERS = 8, BUFFER_BYTES = 640 * 480 * 2, DESCRIPTORS = 1024 };

typedef struct {
  unsigned char *data;
  bool queued;
} Buffer;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
/* Whether each file descriptor is of the camera: programs duplicate them. */
static bool is_camera[DESCRIPTORS];
static struct {
  unsigned descriptors;
  bool streaming;
  struct v4l2_pix_format shape;
  unsigned per_second;
  Buffer buffers[BUFFERS];
  unsigned buffer_count;
  /* Indices of the queued buffers, the first one filled next. */
  unsigned queue[BUFFERS], queued;
  unsigned sequence;
  struct timespec began;
  unsigned char *jpeg;
  size_t jpeg_bytes;
} camera;

static int refuse(int code, const char *why) {
  fprintf(stderr, "camera: refused: %s\n", why);
  errno = code;
  return -1;
}

static int without(int code) {
  errno = code;
  return -1;
}

bool camera_unplugged(void) {
  const char *file = getenv("FARPOINT_CAMERA_UNPLUGGED");
  return file != NULL && access(file, F_OK) == 0;
}

static void note(const char *format, ...) {
  const char *name = getenv("FARPOINT_CAMERA_LOG");
  FILE *log;
  if (name == NULL || (log = fopen(name, "a")) == NULL) return;
  va_list values;
  va_start(values, format);
  vfprintf(log, format, values);
  va_end(values);
  fclose(log);
}

static void read_jpeg(void) {
  const char *name = getenv("FARPOINT_CAMERA_JPEG");
  FILE *file = name == NULL ? NULL : fopen(name, "rb");
  if (file == NULL) return;
  camera.jpeg = malloc(BUFFER_BYTES);
  camera.jpeg_bytes = fread(camera.jpeg, 1, BUFFER_BYTES, file);
  fclose(file);
}

bool camera_owns(int fd) { return fd >= 0 && fd < DESCRIPTORS && is_camera[fd]; }

static void own(int fd) {
  is_camera[fd] = true;
  camera.descriptors++;
}

int camera_open(int flags) {
  if (camera_unplugged()) return without(ENOENT);
  pthread_mutex_lock(&lock);
  int fd = -1;
  if (camera.descriptors > 0) {
    errno = EBUSY;
  } else if ((fd = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | (flags & O_NONBLOCK ? TFD_NONBLOCK : 0))) >= 0) {
    own(fd);
    camera.streaming = false;
    camera.per_second = 30;
    camera.buffer_count = camera.queued = 0;
    camera.shape = (struct v4l2_pix_format){.width = 640, .height = 480, .pixelformat = V4L2_PIX_FMT_YUYV};
    settle(&camera.shape);
    if (camera.jpeg == NULL) read_jpeg();
  }
  pthread_mutex_unlock(&lock);
  return fd;
}

static int stream(int fd, bool on) {
  if (on && camera.buffer_count == 0) return refuse(EINVAL, "a stream without buffers");
  const long interval = on ? 1000000000L / camera.per_second : 0;
  const struct itimerspec timer = {.it_value.tv_nsec = interval, .it_interval.tv_nsec = interval};
  clock_gettime(CLOCK_MONOTONIC, &camera.began);
  camera.streaming = on;
  camera.sequence = 0;
  if (on) {
    note("stream\n");
  } else {
    camera.queued = 0;
    for (unsigned i = 0; i < BUFFERS; i++) camera.buffers[i].queued = false;
  }
  return timerfd_settime(fd, 0, &timer, NULL);
}

static int request_buffers(struct v4l2_requestbuffers *request) {
  if (request->memory != V4L2_MEMORY_MMAP) return without(EINVAL);
  if (camera.streaming) return refuse(EBUSY, "buffers while it streams");
  if (request->count > BUFFERS) request->count = BUFFERS;
  for (unsigned i = 0; i < request->count; i++)
    if (camera.buffers[i].data == NULL)
      camera.buffers[i].data =
          mmap(NULL, BUFFER_BYTES, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  camera.buffer_count = request->count;
  camera.queued = 0;
  request->capabilities = V4L2_BUF_CAP_SUPPORTS_MMAP;
  return 0;
}

static int describe_buffer(struct v4l2_buffer *buffer) {
  if (buffer->index >= camera.buffer_count) return refuse(EINVAL, "no such buffer");
  buffer->memory = V4L2_MEMORY_MMAP;
  buffer->length = camera.shape.sizeimage;
  buffer->m.offset = buffer->index * BUFFER_BYTES;
  buffer->flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  if (camera.buffers[buffer->index].queued) buffer->flags |= V4L2_BUF_FLAG_QUEUED;
  return 0;
}

static int queue_buffer(struct v4l2_buffer *buffer) {
  if (buffer->index >= camera.buffer_count) return refuse(EINVAL, "no such buffer");
  if (buffer->memory != V4L2_MEMORY_MMAP) return refuse(EINVAL, "memory that is not its own");
  Buffer *own = &camera.buffers[buffer->index];
  if (own->queued) return refuse(EINVAL, "a buffer that is queued already");
  own->queued = true;
  camera.queue[camera.queued++] = buffer->index;
  return describe_buffer(buffer);
}

/* Whoever is slow misses pictures: the sequence number counts them all. */
static int dequeue_buffer(int fd, struct v4l2_buffer *buffer) {
  if (!camera.streaming) return refuse(EINVAL, "no stream");
  if (camera_unplugged()) return without(ENODEV);
read_timer:;
  unsigned long long expiries = 0;
  pthread_mutex_unlock(&lock);
  const ssize_t got = read(fd, &expiries, sizeof expiries);
  pthread_mutex_lock(&lock);
  if (got < 0) return -1;
  camera.sequence += (unsigned)expiries;
  if (camera.queued == 0) goto read_timer;
  const unsigned index = camera.queue[0];
  memmove(camera.queue, camera.queue + 1, --camera.queued * sizeof camera.queue[0]);
  camera.buffers[index].queued = false;
  buffer->index = index;
  describe_buffer(buffer);
  const unsigned long long interval = 1000000000ULL / camera.per_second;
  const unsigned long long taken =
      camera.began.tv_sec * 1000000000ULL + camera.began.tv_nsec + camera.sequence * interval;
  const unsigned level = 32 + camera.sequence % 24 * 8;
  if (camera.shape.pixelformat == V4L2_PIX_FMT_MJPEG) {
    memcpy(camera.buffers[index].data, camera.jpeg, camera.jpeg_bytes);
    buffer->bytesused = (unsigned)camera.jpeg_bytes;
  } else {
    buffer->bytesused = camera.shape.sizeimage;
    for (unsigned i = 0; i < buffer->bytesused; i += 2) {
      camera.buffers[index].data[i] = (unsigned char)level;
      camera.buffers[index].data[i + 1] = 128;
    }
  }
  buffer->sequence = camera.sequence;
  buffer->field = V4L2_FIELD_NONE;
  buffer->timestamp.tv_sec = (long)(taken / 1000000000ULL);
  buffer->timestamp.tv_usec = (long)(taken % 1000000000ULL / 1000);
  note("%u %llu\n", level, taken / 1000 * 1000);
  return 0;
}

static int rate(struct v4l2_streamparm *parameters, bool set) {
  struct v4l2_captureparm *capture = &parameters->parm.capture;
  if (set && camera.streaming) return refuse(EBUSY, "a rate while it streams");
  if (set && capture->timeperframe.numerator > 0)
    camera.per_second = capture->timeperframe.denominator / capture->timeperframe.numerator <= 20 ? 15 : 30;
  memset(capture, 0, sizeof *capture);
  capture->capability = V4L2_CAP_TIMEPERFRAME;
  capture->timeperframe.numerator = 1;
  capture->timeperframe.denominator = camera.per_second;
  return 0;
}

static int describe_camera(struct v4l2_capability *capability) {
  memset(capability, 0, sizeof *capability);
  strcpy((char *)capability->driver, "farpoint");
  strcpy((char *)capability->card, "Farpoint test camera");
  strcpy((char *)capability->bus_info, "platform:farpoint");
  capability->device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  capability->capabilities = capability->device_caps | V4L2_CAP_DEVICE_CAPS;
  return 0;
}

static bool is_capture(unsigned type) { return type == V4L2_BUF_TYPE_VIDEO_CAPTURE; }

static int answer(int fd, unsigned long request, void *argument) {
  struct v4l2_format *format = argument;
  switch (request) {
    case VIDIOC_QUERYCAP: return describe_camera(argument);
    case VIDIOC_ENUM_FMT:
      return is_capture(((struct v4l2_fmtdesc *)argument)->type) ? describe_format(argument) : without(EINVAL);
    case VIDIOC_ENUM_FRAMESIZES: return describe_size(argument);
    case VIDIOC_ENUM_FRAMEINTERVALS: return describe_interval(argument);
    case VIDIOC_ENUMINPUT: {
      struct v4l2_input *input = argument;
      if (input->index > 0) return without(EINVAL);
      strcpy((char *)input->name, "Camera");
      input->type = V4L2_INPUT_TYPE_CAMERA;
      return 0;
    }
    case VIDIOC_G_INPUT: *(int *)argument = 0; return 0;
    case VIDIOC_S_INPUT: return *(int *)argument == 0 ? 0 : without(EINVAL);
    case VIDIOC_G_FMT:
      if (!is_capture(format->type)) return without(EINVAL);
      format->fmt.pix = camera.shape;
      return 0;
    case VIDIOC_TRY_FMT:
    case VIDIOC_S_FMT:
      if (!is_capture(format->type)) return without(EINVAL);
      if (request == VIDIOC_S_FMT && camera.streaming) return refuse(EBUSY, "a format while it streams");
      settle(&format->fmt.pix);
      if (request == VIDIOC_S_FMT) camera.shape = format->fmt.pix;
      return 0;
    case VIDIOC_G_PARM: return rate(argument, false);
    case VIDIOC_S_PARM: return rate(argument, true);
    case VIDIOC_REQBUFS: return request_buffers(argument);
    case VIDIOC_QUERYBUF: return describe_buffer(argument);
    case VIDIOC_QBUF: return queue_buffer(argument);
    case VIDIOC_DQBUF: return dequeue_buffer(fd, argument);
    case VIDIOC_STREAMON: return stream(fd, true);
    case VIDIOC_STREAMOFF: return stream(fd, false);
    /* Controls, standards, tuners, cropping, events and exported buffers: a camera need not have them. */
    default: return without(ENOTTY);
  }
}

int camera_ioctl(int fd, unsigned long request, void *argument) {
  pthread_mutex_lock(&lock);
  const int result = answer(fd, request & 0xffffffff, argument);
  pthread_mutex_unlock(&lock);
  return result;
}

void *camera_map(size_t length, off_t offset) {
  const unsigned index = (unsigned)(offset / BUFFER_BYTES);
  if (index < camera.buffer_count && length <= BUFFER_BYTES) return camera.buffers[index].data;
  refuse(EINVAL, "no such buffer");
  return MAP_FAILED;
}

bool camera_mapped(const void *at) {
  for (unsigned i = 0; i < BUFFERS; i++)
    if (camera.buffers[i].data == at && at != NULL) return true;
  return false;
}

void camera_duplicated(int fd) {
  pthread_mutex_lock(&lock);
  own(fd);
  pthread_mutex_unlock(&lock);
}

void camera_close(int fd) {
  pthread_mutex_lock(&lock);
  is_camera[fd] = false;
  camera.descriptors--;
  pthread_mutex_unlock(&lock);
}
