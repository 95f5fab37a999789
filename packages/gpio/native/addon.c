/*
 * One input line of a GPIO chip, through Linux's character device (linux/gpio.h, second version, Linux 5.10). Nothing
 * here blocks for longer than the chip itself takes.
 *
 * open(chip, line, activeLow): a handle. active(handle): whether the line is active. close(handle).
 * Errors have the name of an errno as their code, EIO for any other than those that mean something here; CLOSED for a handle that was closed.
 */
#include <errno.h>
#include <farpoint_addon.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { MOST_PATH = 64 };

static const napi_type_tag LINE_TAG = {0x8d0b3a1c92f7464e, 0xb1c57e20d94a6f38};

struct line {
  int fd;
};

/* Of those that mean something for a line; older systems cannot name them. */
static const char *name_of(int error) {
  switch (error) {
    case ENOENT: return "ENOENT";
    case EACCES: return "EACCES";
    case EPERM: return "EPERM";
    case EBUSY: return "EBUSY";
    case EINVAL: return "EINVAL";
    case ENOTTY: return "ENOTTY";
    case ENODEV: return "ENODEV";
    case ENXIO: return "ENODEV";
    default: return "EIO";
  }
}

static napi_value fail_errno(napi_env env, int error) {
  napi_throw_error(env, name_of(error), strerror(error));
  return NULL;
}

/* A descriptor of the line, or a negative errno. */
static int request_line(const char *path, uint32_t offset, bool active_low) {
  const int chip = open(path, O_RDONLY | O_CLOEXEC);
  if (chip < 0) return -errno;
  struct gpio_v2_line_request request;
  memset(&request, 0, sizeof request);
  request.offsets[0] = offset;
  request.num_lines = 1;
  request.config.flags = GPIO_V2_LINE_FLAG_INPUT | (active_low ? GPIO_V2_LINE_FLAG_ACTIVE_LOW : 0);
  strncpy(request.consumer, "farpoint-stop", sizeof request.consumer - 1);
  const int result = ioctl(chip, GPIO_V2_GET_LINE_IOCTL, &request);
  const int error = errno;
  close(chip);
  if (result < 0) return -error;
  return request.fd < 0 ? -EIO : request.fd;
}

static void close_line(struct line *line) {
  if (line->fd >= 0) close(line->fd);
  line->fd = -1;
}

static void finalize_line(napi_env env, void *data, void *hint) {
  close_line(data);
  free(data);
}

static napi_value js_open(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS], object;
  char path[MOST_PATH];
  uint32_t offset = 0;
  bool active_low = false;
  if (!take_arguments(env, info, 3, values)) return NULL;
  if (!read_text(env, values[0], path, sizeof path) || napi_get_value_uint32(env, values[1], &offset) != napi_ok) {
    refuse(env, "needs a chip and a line");
    return NULL;
  }
  if (!take_bool(env, values[2], &active_low)) return NULL;
  struct line *line = malloc(sizeof *line);
  if (line == NULL) return fail_errno(env, ENOMEM);
  line->fd = request_line(path, offset, active_low);
  if (line->fd < 0) {
    const int error = -line->fd;
    free(line);
    return fail_errno(env, error);
  }
  if (napi_create_object(env, &object) != napi_ok ||
      napi_wrap(env, object, line, finalize_line, NULL, NULL) != napi_ok) {
    close_line(line);
    free(line);
    return fail_errno(env, ENOMEM);
  }
  napi_type_tag_object(env, object, &LINE_TAG);
  return object;
}

static struct line *line_of(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  void *line = NULL;
  if (!take_arguments(env, info, 1, values) || !take_handle(env, values[0], &LINE_TAG, &line)) return NULL;
  return line;
}

static napi_value js_active(napi_env env, napi_callback_info info) {
  struct line *line = line_of(env, info);
  if (line == NULL) return NULL;
  if (line->fd < 0) {
    napi_throw_error(env, "CLOSED", "the line was closed");
    return NULL;
  }
  struct gpio_v2_line_values read = {.bits = 0, .mask = 1};
  if (ioctl(line->fd, GPIO_V2_LINE_GET_VALUES_IOCTL, &read) < 0) return fail_errno(env, errno);
  napi_value active;
  napi_get_boolean(env, (read.bits & 1) != 0, &active);
  return active;
}

static napi_value js_close(napi_env env, napi_callback_info info) {
  struct line *line = line_of(env, info);
  if (line != NULL) close_line(line);
  return NULL;
}

NAPI_MODULE_INIT() {
  static const struct addon_function functions[] = {{"open", js_open}, {"active", js_active}, {"close", js_close}};
  return EXPORT_FUNCTIONS(env, exports, functions) ? exports : NULL;
}
