/*
 * Stands in for a GPIO chip, because no machine for tests has one: loaded with LD_PRELOAD, it answers what a kernel
 * would be asked for /dev/gpiochip7, and as strictly: padding must be zero, flags must make sense, a line can be
 * requested once. The level of line N is the first character of the file `N` in $FAKE_GPIO, `0` or `1`; without the
 * file, the chip is gone.
 */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#define CHIP "/dev/gpiochip7"
enum { LINES = 32, MOST_FD = 4096 };

enum what { NOTHING, A_CHIP, A_LINE };
static struct {
  enum what what;
  unsigned offset;
  bool active_low;
} known[MOST_FD];
static bool requested[LINES];

static int refused(int error) {
  errno = error;
  return -1;
}

static int open_null(enum what what) {
  const int fd = (int)syscall(SYS_openat, AT_FDCWD, "/dev/null", O_RDONLY | O_CLOEXEC, 0);
  if (fd >= 0 && fd < MOST_FD) known[fd].what = what;
  return fd;
}

/* -1 if the chip is gone. */
static int level_of(unsigned offset) {
  const char *folder = getenv("FAKE_GPIO");
  char path[512], level = 0;
  snprintf(path, sizeof path, "%s/%u", folder == NULL ? "" : folder, offset);
  const int fd = (int)syscall(SYS_openat, AT_FDCWD, path, O_RDONLY | O_CLOEXEC, 0);
  if (fd < 0) return -1;
  const bool read_it = syscall(SYS_read, fd, &level, 1) == 1;
  syscall(SYS_close, fd);
  return !read_it || (level != '0' && level != '1') ? -1 : level - '0';
}

static bool is_zero(const void *bytes, size_t length) {
  const unsigned char *each = bytes;
  for (size_t i = 0; i < length; i++)
    if (each[i] != 0) return false;
  return true;
}

static int get_line(struct gpio_v2_line_request *request) {
  const __u64 allowed = GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_ACTIVE_LOW;
  const struct gpio_v2_line_config *config = &request->config;
  if (request->num_lines != 1 || request->offsets[0] >= LINES) return refused(EINVAL);
  if (!is_zero(request->padding, sizeof request->padding)) return refused(EINVAL);
  if (!is_zero(config->padding, sizeof config->padding) || config->num_attrs != 0) return refused(EINVAL);
  if ((config->flags & ~allowed) != 0 || !(config->flags & GPIO_V2_LINE_FLAG_INPUT)) return refused(EINVAL);
  if (memchr(request->consumer, 0, sizeof request->consumer) == NULL) return refused(EINVAL);
  const unsigned offset = request->offsets[0];
  if (requested[offset]) return refused(EBUSY);
  if (level_of(offset) < 0) return refused(ENODEV);
  request->fd = open_null(A_LINE);
  if (request->fd < 0) return -1;
  known[request->fd].offset = offset;
  known[request->fd].active_low = (config->flags & GPIO_V2_LINE_FLAG_ACTIVE_LOW) != 0;
  requested[offset] = true;
  return 0;
}

static int get_values(int fd, struct gpio_v2_line_values *values) {
  if (values->mask != 1) return refused(EINVAL);
  const int level = level_of(known[fd].offset);
  if (level < 0) return refused(ENODEV);
  values->bits = (__u64)(level != known[fd].active_low);
  return 0;
}

int ioctl(int fd, unsigned long request, ...) {
  va_list arguments;
  va_start(arguments, request);
  void *argument = va_arg(arguments, void *);
  va_end(arguments);
  const enum what what = fd >= 0 && fd < MOST_FD ? known[fd].what : NOTHING;
  if (what == NOTHING) return (int)syscall(SYS_ioctl, fd, request, argument);
  if (what == A_CHIP && request == GPIO_V2_GET_LINE_IOCTL) return get_line(argument);
  if (what == A_LINE && request == GPIO_V2_LINE_GET_VALUES_IOCTL) return get_values(fd, argument);
  return refused(ENOTTY);
}

static int open_any(const char *path, int flags, mode_t mode) {
  if (strcmp(path, CHIP) == 0) return open_null(A_CHIP);
  return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}

#define OPENS(name)                                \
  int name(const char *path, int flags, ...) {     \
    mode_t mode = 0;                               \
    if (flags & (O_CREAT | O_TMPFILE)) {           \
      va_list arguments;                           \
      va_start(arguments, flags);                  \
      mode = va_arg(arguments, mode_t);            \
      va_end(arguments);                           \
    }                                              \
    return open_any(path, flags, mode);            \
  }
OPENS(open)
OPENS(open64)

int close(int fd) {
  if (fd >= 0 && fd < MOST_FD) {
    if (known[fd].what == A_LINE) requested[known[fd].offset] = false;
    known[fd].what = NOTHING;
  }
  return (int)syscall(SYS_close, fd);
}
