/*
 * Farpoint shared memory for producers: a depth camera's program gives its frames to the robot.
 *
 * Header-only, C99 or C++11, GCC or Clang, Linux. The layouts are specified in docs/shared-memory.md. Functions return 0 or
 * an errno. A producer belongs to one thread at a time. It may be killed at any instant: readers never see half a frame,
 * and the next producer takes over.
 *
 *   struct fp_cloud cloud;
 *   struct fp_cloud_config config = {0};
 *   config.format = FP_POINTS;
 *   config.max_points = 480 * 480;
 *   if (fp_cloud_open(&cloud, &config) != 0) ...
 *   for (;;) {
 *     float *points = fp_cloud_begin(&cloud);      // x, y, z in metres, then the bytes R, G, B, A
 *     ... fill 480 * 480 points ...
 *     struct fp_frame frame = {0};
 *     frame.width = 480, frame.height = 480, frame.capture_ns = fp_now_ns();
 *     if (fp_cloud_publish(&cloud, &frame) != 0) ...
 *   }
 *
 * SPDX-License-Identifier: Apache-2.0
 */
#ifndef FARPOINT_SHM_H
#define FARPOINT_SHM_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/futex.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "the layouts are little-endian"
#endif

#define FP_HEADER_BYTES 4096u
#define FP_SLOT_HEADER_BYTES 128u
#define FP_PUBLISHED_OFFSET 64u
#define FP_MAX_POINTS 4194304u
#define FP_REFERENCE_PAYLOAD_BYTES 1843200u
#define FP_PATH_BYTES 512

/* CLOCK_MONOTONIC: the time of fp_frame.capture_ns. */
static inline uint64_t fp_now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

/* Opens or creates a file with exactly `bytes` bytes that is not a link and not writable by everybody; maps it. */
static inline int fp_map_(const char *path, size_t bytes, unsigned mode, int exclusive, int *fd, uint8_t **base) {
  const int flags = O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  struct stat status;
  int error;
  int file = -1;
  if (!exclusive) file = open(path, flags);
  if (file < 0) {
    if (!exclusive && errno != ENOENT) return errno;
    file = open(path, flags | O_CREAT | O_EXCL, mode);
    if (file < 0) return errno;
    if (fchmod(file, mode) != 0) goto failed;
  }
  if (fstat(file, &status) != 0) goto failed;
  if (!S_ISREG(status.st_mode) || (status.st_mode & S_IWOTH) != 0) {
    errno = EPERM;
    goto failed;
  }
  if ((size_t)status.st_size != bytes && ftruncate(file, (off_t)bytes) != 0) goto failed;
  *base = (uint8_t *)mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (*base == (uint8_t *)MAP_FAILED) goto failed;
  *fd = file;
  return 0;
failed:
  error = errno;
  close(file);
  return error;
}

/* Farpoint's layout ------------------------------------------------------------------------------------------------ */

enum fp_format {
  /* 16 bytes per point: x, y, z as float in metres (optical frame: x right, y down, z forward), then R, G, B, A. */
  FP_POINTS = 1,
  /* uint16_t depth in units of depth_unit metres, 0 if none was measured; then R, G, B, A of each pixel. */
  FP_DEPTH16 = 2,
  /* float depth in metres; then R, G, B, A of each pixel. */
  FP_DEPTH32 = 3
};

struct fp_cloud_config {
  enum fp_format format;
  /* Of a frame, at most 4194304. */
  uint32_t max_points;
  /* The camera's frame rate, for the robot's planning; 0 if unknown. */
  float frames_per_second;
  /* Default /dev/shm. */
  const char *folder;
  /* Default 0600; 0660 for a group. */
  unsigned mode;
};

struct fp_frame {
  /* CLOCK_MONOTONIC when the picture was taken; 0 if unknown. */
  uint64_t capture_ns;
  /* width * height points; height 1 if they are not on a grid. */
  uint32_t width;
  uint32_t height;
  /* The camera's optical frame in the world (x forward, y left, z up): has_pose, metres, unit quaternion x, y, z, w. */
  int has_pose;
  double position[3];
  double orientation[4];
  /*
   * Pinhole model of the grid: has_lens, fx, fy, cx, cy in pixels. Needed for depth. With it, points must lie on its
   * rays.
   */
  int has_lens;
  double lens[4];
  /* Every point was made green for a latency test. */
  int latency_test;
  /* Metres per unit of FP_DEPTH16, for example 0.001f. */
  float depth_unit;
};

struct fp_cloud {
  int fd;
  uint8_t *base;
  size_t bytes;
  size_t slot_bytes;
  uint32_t max_points;
  uint32_t frame;
  enum fp_format format;
};

enum { FP_SLOTS = 4 };

static inline size_t fp_align64_(size_t bytes) { return (bytes + 63u) / 64u * 64u; }

/* Offset of a depth frame's colours within its payload. */
static inline size_t fp_colour_offset(enum fp_format format, uint32_t width, uint32_t height) {
  return fp_align64_((size_t)width * height * (format == FP_DEPTH16 ? 2u : 4u));
}

static inline size_t fp_payload_bytes_(enum fp_format format, uint32_t points) {
  return format == FP_POINTS ? (size_t)points * 16u : fp_colour_offset(format, points, 1) + (size_t)points * 4u;
}

static inline void fp_put32_(uint8_t *at, uint32_t value) { memcpy(at, &value, sizeof value); }

/*
 * Creates the file; EBUSY while another producer is running. The file is created under a temporary name and then
 * renamed.
 */
static inline int fp_cloud_open(struct fp_cloud *cloud, const struct fp_cloud_config *config) {
  char path[FP_PATH_BYTES];
  char unfinished[FP_PATH_BYTES + 8];
  const char *folder = config->folder != NULL ? config->folder : "/dev/shm";
  const unsigned mode = config->mode != 0 ? config->mode & 0660u : 0600u;
  int former;
  int error;
  memset(cloud, 0, sizeof *cloud);
  cloud->fd = -1;
  if (config->format < FP_POINTS || config->format > FP_DEPTH32 || config->max_points < 1 ||
      config->max_points > FP_MAX_POINTS || !(config->frames_per_second >= 0 && config->frames_per_second <= 1000)) {
    return EINVAL;
  }
  if (snprintf(path, sizeof path, "%s/farpoint_cloud", folder) >= (int)sizeof path) return ENAMETOOLONG;
  snprintf(unfinished, sizeof unfinished, "%s.new", path);
  former = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (former >= 0 && flock(former, LOCK_EX | LOCK_NB) != 0) {
    close(former);
    return EBUSY;
  }
  cloud->format = config->format;
  cloud->max_points = config->max_points;
  cloud->slot_bytes = fp_align64_(FP_SLOT_HEADER_BYTES + fp_payload_bytes_(config->format, config->max_points));
  cloud->bytes = FP_HEADER_BYTES + FP_SLOTS * cloud->slot_bytes;
  error = fp_map_(unfinished, cloud->bytes, mode, 1, &cloud->fd, &cloud->base);
  if (error == EEXIST) {
    /* Left behind by a producer that was killed while it started. */
    unlink(unfinished);
    error = fp_map_(unfinished, cloud->bytes, mode, 1, &cloud->fd, &cloud->base);
  }
  if (error == 0) {
    memcpy(cloud->base, "FARPOINT", 8);
    fp_put32_(cloud->base + 8, 1);
    fp_put32_(cloud->base + 12, FP_HEADER_BYTES);
    fp_put32_(cloud->base + 16, (uint32_t)config->format);
    fp_put32_(cloud->base + 20, FP_SLOTS);
    fp_put32_(cloud->base + 24, (uint32_t)cloud->slot_bytes);
    fp_put32_(cloud->base + 28, config->max_points);
    memcpy(cloud->base + 32, &config->frames_per_second, 4);
    fp_put32_(cloud->base + 36, (uint32_t)getpid());
    if (flock(cloud->fd, LOCK_EX | LOCK_NB) != 0 || rename(unfinished, path) != 0) {
      error = errno;
      munmap(cloud->base, cloud->bytes);
      close(cloud->fd);
      cloud->fd = -1;
    }
  }
  if (former >= 0) close(former);
  return error;
}

static inline uint8_t *fp_slot_(struct fp_cloud *cloud) {
  return cloud->base + FP_HEADER_BYTES + (size_t)((cloud->frame + 1) % FP_SLOTS) * cloud->slot_bytes;
}

/*
 * Begins the next frame: returns where its payload goes, aligned to 64 bytes. Until it is published, readers see the
 * previous frame. If a frame is begun and not published, the next call begins it again.
 */
static inline void *fp_cloud_begin(struct fp_cloud *cloud) {
  uint8_t *slot = fp_slot_(cloud);
  const uint32_t frame = cloud->frame + 1;
  __atomic_store_n((uint32_t *)(void *)slot, frame * 2 - 1, __ATOMIC_RELAXED);
  /* No byte of the frame may become visible before the closed lock does. */
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  return slot + FP_SLOT_HEADER_BYTES;
}

static inline int fp_is_finite_(double value) { return value - value == 0; }

static inline int fp_frame_is_right_(const struct fp_cloud *cloud, const struct fp_frame *frame) {
  const double *q = frame->orientation;
  if (frame->height < 1 || (uint64_t)frame->width * frame->height > cloud->max_points) return 0;
  if (frame->has_pose) {
    const double norm2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(norm2 > 0.9801 && norm2 < 1.0201)) return 0;
    for (int i = 0; i < 3; i++)
      if (!fp_is_finite_(frame->position[i])) return 0;
  }
  if (cloud->format != FP_POINTS && !frame->has_lens) return 0;
  if (frame->has_lens) {
    for (int i = 0; i < 4; i++)
      if (!fp_is_finite_(frame->lens[i])) return 0;
    if (!(frame->lens[0] > 0 && frame->lens[1] > 0)) return 0;
  }
  return cloud->format != FP_DEPTH16 || (frame->depth_unit > 0 && frame->depth_unit <= 1);
}

/* Publishes the frame that was begun. EINVAL if it is invalid, ESTALE if another file has replaced this one. */
static inline int fp_cloud_publish(struct fp_cloud *cloud, const struct fp_frame *info) {
  uint8_t *slot = fp_slot_(cloud);
  const uint32_t frame = cloud->frame + 1;
  struct stat status;
  if (!fp_frame_is_right_(cloud, info)) return EINVAL;
  if (fstat(cloud->fd, &status) != 0 || status.st_nlink == 0 || (size_t)status.st_size != cloud->bytes) return ESTALE;
  memset(slot + 4, 0, FP_SLOT_HEADER_BYTES - 4);
  fp_put32_(slot + 4, frame);
  memcpy(slot + 8, &info->capture_ns, 8);
  fp_put32_(slot + 16, info->width);
  fp_put32_(slot + 20, info->height);
  fp_put32_(slot + 24, (info->has_pose ? 1u : 0u) | (info->has_lens ? 2u : 0u) | (info->latency_test ? 4u : 0u));
  if (info->has_pose) {
    memcpy(slot + 32, info->position, 24);
    memcpy(slot + 56, info->orientation, 32);
  }
  if (info->has_lens) memcpy(slot + 88, info->lens, 32);
  if (cloud->format == FP_DEPTH16) memcpy(slot + 120, &info->depth_unit, 4);
  __atomic_store_n((uint32_t *)(void *)slot, frame * 2, __ATOMIC_RELEASE);
  __atomic_store_n((uint32_t *)(void *)(cloud->base + FP_PUBLISHED_OFFSET), frame, __ATOMIC_RELEASE);
  syscall(SYS_futex, cloud->base + FP_PUBLISHED_OFFSET, FUTEX_WAKE, INT_MAX, NULL, NULL, 0);
  cloud->frame = frame;
  return 0;
}

static inline void fp_cloud_close(struct fp_cloud *cloud) {
  if (cloud->fd < 0) return;
  munmap(cloud->base, cloud->bytes);
  close(cloud->fd);
  cloud->fd = -1;
}

/* The reference system's layout ------------------------------------------------------------------------------------ */

struct fp_reference {
  int cloud_fd;
  int flags_fd;
  uint8_t *cloud;
  uint8_t *flags;
};

/* Creates the files, or continues with existing ones. */
static inline int fp_reference_open(struct fp_reference *reference, const char *folder, unsigned mode) {
  char path[FP_PATH_BYTES];
  int error;
  if (folder == NULL) folder = "/dev/shm";
  mode = mode != 0 ? mode & 0660u : 0600u;
  if (snprintf(path, sizeof path, "%s/shared_pc", folder) >= (int)sizeof path) return ENAMETOOLONG;
  error = fp_map_(path, 3 + FP_REFERENCE_PAYLOAD_BYTES, mode, 0, &reference->cloud_fd, &reference->cloud);
  if (error != 0) return error;
  if (snprintf(path, sizeof path, "%s/semaphore_read", folder) >= (int)sizeof path) return ENAMETOOLONG;
  error = fp_map_(path, 6, mode, 0, &reference->flags_fd, &reference->flags);
  if (error != 0) {
    munmap(reference->cloud, 3 + FP_REFERENCE_PAYLOAD_BYTES);
    close(reference->cloud_fd);
  }
  return error;
}

/*
 * Waits until the last frame was taken: ETIMEDOUT if it was not in time. Then returns the robot's request: the rate
 * that the frame should fit, and whether it should be green (0x03F0).
 */
static inline int fp_reference_wait(struct fp_reference *reference, uint32_t timeout_ms, uint32_t *bits_per_second,
                                    int *latency_test) {
  const uint64_t deadline = fp_now_ns() + (uint64_t)timeout_ms * 1000000u;
  while (__atomic_load_n(reference->flags, __ATOMIC_ACQUIRE) != 0) {
    const struct timespec pause = {0, 500000};
    if (fp_now_ns() >= deadline) return ETIMEDOUT;
    nanosleep(&pause, NULL);
  }
  memcpy(bits_per_second, reference->flags + 2, 4);
  *latency_test = reference->flags[1] == 1;
  return 0;
}

/* Blocks of 150 points, 1200 bytes: 150 x (x, y, z as int16 millimetres), then 150 x colour (6-6-4 bits). */
static inline uint8_t *fp_reference_payload(struct fp_reference *reference) { return reference->cloud + 3; }

/* Only after fp_reference_wait: publishes `bytes` of the payload. */
static inline int fp_reference_publish(struct fp_reference *reference, uint32_t bytes) {
  if (bytes > FP_REFERENCE_PAYLOAD_BYTES || bytes % 8 != 0) return EINVAL;
  reference->cloud[0] = (uint8_t)(bytes & 0xff);
  reference->cloud[1] = (uint8_t)(bytes >> 8 & 0xff);
  reference->cloud[2] = (uint8_t)(bytes >> 16);
  __atomic_store_n(reference->flags, (uint8_t)1, __ATOMIC_RELEASE);
  return 0;
}

static inline void fp_reference_close(struct fp_reference *reference) {
  munmap(reference->cloud, 3 + FP_REFERENCE_PAYLOAD_BYTES);
  munmap(reference->flags, 6);
  close(reference->cloud_fd);
  close(reference->flags_fd);
}

#endif
