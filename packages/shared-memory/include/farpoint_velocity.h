/*
 * Farpoint shared memory for what moves the wheels: reads the velocities that the robot writes with --sink shm.
 *
 * Header-only, C99 or C++11, GCC or Clang, Linux. The layout is specified in docs/shared-memory.md. The velocity is zero
 * unless the robot is alive: when it is silent for longer than a given time, was killed, or has left a stale or
 * half-written file. A reader belongs to one thread. Nothing that happens to the files raises a signal.
 *
 *   struct fp_velocity_reader reader;
 *   struct fp_velocity_config config = {0};
 *   config.silence_ms = 200;
 *   config.answers = 1;
 *   if (fp_velocity_open(&reader, &config) != 0) ...
 *   for (;;) {                                         // at the rate of the motors, at least 20 times a second
 *     struct fp_velocity velocity;
 *     fp_velocity_read(&reader, &velocity);            // zero unless it returns FP_VELOCITY_FRESH
 *     ... give velocity.linear[0] and velocity.angular[2] to the wheels ...
 *     fp_velocity_answer(&reader);
 *   }
 *
 * This program can hang or be killed, too: let the motors' controller stop by itself when it gets nothing new.
 *
 * SPDX-License-Identifier: Apache-2.0
 */
#ifndef FARPOINT_VELOCITY_H
#define FARPOINT_VELOCITY_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "the layouts are little-endian"
#endif

#define FP_VELOCITY_BLOCK_BYTES 52
#define FP_VELOCITY_BUSY_BYTES 5
/* The robot writes every 40 ms: a shorter time would stop it for nothing. */
#define FP_VELOCITY_LEAST_SILENCE_MS 100u
#define FP_VELOCITY_MOST_SILENCE_MS 5000u
#define FP_VELOCITY_PATH_BYTES 512

struct fp_velocity {
  /* x forward, y to the left, z up; m/s. */
  double linear[3];
  /* About the same axes; rad/s. */
  double angular[3];
};

/* Why the velocity is what it is. It is zero unless it is fresh. */
enum fp_velocity_state {
  FP_VELOCITY_FRESH = 0,
  /* The file is there, but has not changed since it was opened: it may be left from an earlier run. */
  FP_VELOCITY_UNHEARD,
  /* Nothing complete was written for silence_ms. */
  FP_VELOCITY_SILENT,
  /* There are no such files, or they are refused: reader.error says why (an errno; EPERM for an unsafe file). */
  FP_VELOCITY_ABSENT,
  /* A velocity that is not finite. */
  FP_VELOCITY_INVALID
};

struct fp_velocity_config {
  /* The wheels stop after this long without a write: 100 to 5000, default 200. */
  unsigned silence_ms;
  /* Default /dev/shm. */
  const char *folder;
  /* Whether fp_velocity_answer will be called, for which this program must be permitted to write semaphore_ros_read. */
  int answers;
  /* The robot's user, if it is neither this program's nor root: whoever owns the files can move the robot. */
  uid_t owner;
};

struct fp_velocity_reader {
  char block_path[FP_VELOCITY_PATH_BYTES];
  char busy_path[FP_VELOCITY_PATH_BYTES];
  int block_fd;
  int busy_fd;
  int answers;
  int error;
  uid_t owner;
  uint64_t silence_ns;
  /* The newest complete block. */
  struct fp_velocity velocity;
  uint32_t counter;
  int has_counter;
  /* Whether the counter has changed since the files were opened, and when that was seen last. */
  int is_heard;
  int is_invalid;
  uint64_t changed_ns;
  uint64_t looked_ns;
};

/* Also counts while the machine sleeps: what was written before is no longer fresh after. */
static inline uint64_t fp_velocity_now_ns_(void) {
  struct timespec now;
  clock_gettime(CLOCK_BOOTTIME, &now);
  return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

static inline void fp_velocity_forget_(struct fp_velocity_reader *reader) {
  if (reader->block_fd >= 0) close(reader->block_fd);
  if (reader->busy_fd >= 0) close(reader->busy_fd);
  reader->block_fd = reader->busy_fd = -1;
  reader->has_counter = reader->is_heard = reader->is_invalid = 0;
}

/* A file with exactly `bytes` bytes that is not a link, and that nobody but the right users can write. */
static inline int fp_velocity_file_(const char *path, int writable, off_t bytes, uid_t owner, int *fd) {
  struct stat status;
  int error = 0;
  const int file = open(path, (writable ? O_RDWR : O_RDONLY) | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) return errno;
  if (fstat(file, &status) != 0) error = errno;
  else if (!S_ISREG(status.st_mode) || (status.st_mode & S_IWOTH) != 0) error = EPERM;
  else if (status.st_uid != geteuid() && status.st_uid != 0 && status.st_uid != owner) error = EPERM;
  else if (status.st_size != bytes) error = EINVAL;
  if (error != 0) {
    close(file);
    return error;
  }
  *fd = file;
  return 0;
}

static inline int fp_velocity_is_current_(int fd, off_t bytes) {
  struct stat status;
  return fstat(fd, &status) == 0 && status.st_nlink > 0 && status.st_size == bytes;
}

static inline int fp_velocity_find_(struct fp_velocity_reader *reader) {
  if (reader->block_fd >= 0 && fp_velocity_is_current_(reader->block_fd, FP_VELOCITY_BLOCK_BYTES) &&
      fp_velocity_is_current_(reader->busy_fd, FP_VELOCITY_BUSY_BYTES)) {
    return 0;
  }
  fp_velocity_forget_(reader);
  reader->error = fp_velocity_file_(reader->block_path, 0, FP_VELOCITY_BLOCK_BYTES, reader->owner, &reader->block_fd);
  if (reader->error == 0) {
    reader->error =
        fp_velocity_file_(reader->busy_path, reader->answers, FP_VELOCITY_BUSY_BYTES, reader->owner, &reader->busy_fd);
  }
  if (reader->error != 0) fp_velocity_forget_(reader);
  return reader->error;
}

/* Begins. The files need not exist yet. EINVAL for an impossible silence_ms, ENAMETOOLONG. */
static inline int fp_velocity_open(struct fp_velocity_reader *reader, const struct fp_velocity_config *config) {
  const char *folder = config->folder != NULL ? config->folder : "/dev/shm";
  const unsigned silence_ms = config->silence_ms != 0 ? config->silence_ms : 200u;
  memset(reader, 0, sizeof *reader);
  reader->block_fd = reader->busy_fd = -1;
  if (silence_ms < FP_VELOCITY_LEAST_SILENCE_MS || silence_ms > FP_VELOCITY_MOST_SILENCE_MS) return EINVAL;
  reader->silence_ns = (uint64_t)silence_ms * 1000000u;
  reader->answers = config->answers;
  reader->owner = config->owner;
  if (snprintf(reader->block_path, FP_VELOCITY_PATH_BYTES, "%s/shared_control", folder) >= FP_VELOCITY_PATH_BYTES ||
      snprintf(reader->busy_path, FP_VELOCITY_PATH_BYTES, "%s/semaphore_ros_read", folder) >= FP_VELOCITY_PATH_BYTES) {
    return ENAMETOOLONG;
  }
  return 0;
}

/* Copies the block unless it is being written: 1 if it is complete. Files are read, not mapped: nothing can fault. */
static inline int fp_velocity_copy_(const struct fp_velocity_reader *reader, uint8_t *block) {
  uint8_t busy = 1;
  uint8_t again[4];
  if (pread(reader->busy_fd, &busy, 1, 0) != 1 || busy != 0) return 0;
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  if (pread(reader->block_fd, block, FP_VELOCITY_BLOCK_BYTES, 0) != FP_VELOCITY_BLOCK_BYTES) return 0;
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  if (pread(reader->busy_fd, &busy, 1, 0) != 1 || busy != 0) return 0;
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  /* A complete write may have happened meanwhile, which changes the counter. */
  return pread(reader->block_fd, again, sizeof again, 0) == (ssize_t)sizeof again && memcmp(block, again, 4) == 0;
}

/* By its bits: -ffast-math takes every number for finite. */
static inline int fp_velocity_is_finite_(const uint8_t *at) {
  uint64_t bits;
  memcpy(&bits, at, sizeof bits);
  return (bits >> 52 & 0x7ffu) != 0x7ffu;
}

static inline void fp_velocity_take_(struct fp_velocity_reader *reader, const uint8_t *block, uint64_t now_ns) {
  uint32_t counter;
  memcpy(&counter, block, sizeof counter);
  if (reader->has_counter && counter == reader->counter) return;
  /* What the files held before this program looked, or while it did not, may be old. */
  if (reader->has_counter && now_ns - reader->looked_ns <= reader->silence_ns) {
    reader->is_heard = 1;
    reader->changed_ns = now_ns;
  } else {
    reader->is_heard = 0;
  }
  reader->has_counter = 1;
  reader->counter = counter;
  memcpy(reader->velocity.linear, block + 4, 24);
  memcpy(reader->velocity.angular, block + 28, 24);
  reader->is_invalid = 0;
  for (int i = 0; i < 6; i++)
    if (!fp_velocity_is_finite_(block + 4 + i * 8)) reader->is_invalid = 1;
}

/* The same as fp_velocity_read at a time of the caller's clock, which must not step back. */
static inline enum fp_velocity_state fp_velocity_read_at(struct fp_velocity_reader *reader, uint64_t now_ns,
                                                         struct fp_velocity *velocity) {
  uint8_t block[FP_VELOCITY_BLOCK_BYTES];
  memset(velocity, 0, sizeof *velocity);
  if (fp_velocity_find_(reader) != 0) return FP_VELOCITY_ABSENT;
  /* A write takes less than a microsecond. */
  for (int attempt = 0; attempt < 3; attempt++) {
    if (!fp_velocity_copy_(reader, block)) continue;
    fp_velocity_take_(reader, block, now_ns);
    break;
  }
  const int was_absent = now_ns - reader->looked_ns > reader->silence_ns;
  reader->looked_ns = now_ns;
  if (!reader->is_heard) return FP_VELOCITY_UNHEARD;
  if (was_absent || now_ns - reader->changed_ns > reader->silence_ns) return FP_VELOCITY_SILENT;
  if (reader->is_invalid) return FP_VELOCITY_INVALID;
  *velocity = reader->velocity;
  return FP_VELOCITY_FRESH;
}

/* The velocity for the wheels now; zero unless it returns FP_VELOCITY_FRESH. Call it at least 20 times a second. */
static inline enum fp_velocity_state fp_velocity_read(struct fp_velocity_reader *reader, struct fp_velocity *velocity) {
  return fp_velocity_read_at(reader, fp_velocity_now_ns_(), velocity);
}

/*
 * Tells the robot that the wheels have been given the velocity that was read last. A robot that was answered once stops when
 * the answers end. Returns 0 or an errno.
 */
static inline int fp_velocity_answer(struct fp_velocity_reader *reader) {
  const uint8_t echo = (uint8_t)(reader->counter & 0xff);
  if (!reader->answers) return EBADF;
  if (reader->busy_fd < 0 || !reader->is_heard) return EAGAIN;
  if (!fp_velocity_is_current_(reader->busy_fd, FP_VELOCITY_BUSY_BYTES)) return ESTALE;
  return pwrite(reader->busy_fd, &echo, 1, 1) == 1 ? 0 : errno;
}

static inline void fp_velocity_close(struct fp_velocity_reader *reader) { fp_velocity_forget_(reader); }

#endif
