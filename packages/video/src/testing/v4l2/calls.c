/* The calls of a program that are meant for the camera go there (camera.c), all others to the system. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include "camera.h"

static const char DEVICE[] = "/dev/farpoint-camera";
enum { VIDEO4LINUX_MAJOR = 81 };

#define THE_REAL(name) ((typeof(&name))dlsym(RTLD_NEXT, #name))

static int opened(const char *path, int flags, mode_t mode, const char *real) {
  if (strcmp(path, DEVICE) == 0) return camera_open(flags);
  return ((int (*)(const char *, int, ...))dlsym(RTLD_NEXT, real))(path, flags, mode);
}

static mode_t mode_of(int flags, va_list more) {
  return (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
}

int open(const char *path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return opened(path, flags, mode, "open");
}

int open64(const char *path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return opened(path, flags, mode, "open64");
}

/* The test for a character device. */
int stat(const char *path, struct stat *status) {
  if (strcmp(path, DEVICE) != 0) return THE_REAL(stat)(path, status);
  if (camera_unplugged()) {
    errno = ENOENT;
    return -1;
  }
  memset(status, 0, sizeof *status);
  status->st_mode = S_IFCHR | 0660;
  status->st_rdev = makedev(VIDEO4LINUX_MAJOR, 0);
  return 0;
}

int stat64(const char *path, struct stat64 *status) { return stat(path, (struct stat *)status); }

int ioctl(int fd, unsigned long request, ...) {
  va_list more;
  va_start(more, request);
  void *argument = va_arg(more, void *);
  va_end(more);
  return camera_owns(fd) ? camera_ioctl(fd, request, argument) : THE_REAL(ioctl)(fd, request, argument);
}

void *mmap(void *at, size_t length, int protection, int flags, int fd, off_t offset) {
  if (camera_owns(fd)) return camera_map(length, offset);
  return THE_REAL(mmap)(at, length, protection, flags, fd, offset);
}

void *mmap64(void *at, size_t length, int protection, int flags, int fd, off_t offset) {
  return mmap(at, length, protection, flags, fd, offset);
}

int munmap(void *at, size_t length) { return camera_mapped(at) ? 0 : THE_REAL(munmap)(at, length); }

int dup(int fd) {
  const int copy = THE_REAL(dup)(fd);
  if (copy >= 0 && camera_owns(fd)) camera_duplicated(copy);
  return copy;
}

int close(int fd) {
  if (camera_owns(fd)) camera_close(fd);
  return THE_REAL(close)(fd);
}
