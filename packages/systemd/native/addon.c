/*
 * notify(socket, message): sends one datagram to a Unix socket, as described in sd_notify(3). Node has no such sockets
 * of its own. A path that begins with @ names an abstract socket. Never blocks: a message that does not fit the queue
 * is refused.
 */
#include <errno.h>
#include <farpoint_addon.h>
#include <stddef.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

enum { MOST_MESSAGE = 4096 };

/* Returns 0, or an errno. */
static int send_datagram(const char *path, size_t path_length, const char *message, size_t length) {
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  if (path_length < 2 || path_length >= sizeof address.sun_path) return EINVAL;
  memcpy(address.sun_path, path, path_length);
  socklen_t size = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + path_length + 1);
  if (path[0] == '@') {
    address.sun_path[0] = '\0';
    size--;
  }
  int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) return errno;
  ssize_t sent = sendto(fd, message, length, MSG_NOSIGNAL, (struct sockaddr *)&address, size);
  int error = sent < 0 ? errno : 0;
  close(fd);
  return error;
}

static napi_value notify(napi_env env, napi_callback_info info) {
  size_t count = 2;
  napi_value arguments[2];
  char path[sizeof((struct sockaddr_un *)0)->sun_path + 1];
  char message[MOST_MESSAGE];
  size_t path_length = 0, length = 0;
  if (napi_get_cb_info(env, info, &count, arguments, NULL, NULL) != napi_ok || count < 2 ||
      napi_get_value_string_utf8(env, arguments[0], path, sizeof path, &path_length) != napi_ok ||
      napi_get_value_string_utf8(env, arguments[1], message, sizeof message, &length) != napi_ok) {
    napi_throw_type_error(env, "RANGE", "needs a socket and a message");
    return NULL;
  }
  napi_value result;
  napi_create_int32(env, send_datagram(path, path_length, message, length), &result);
  return result;
}

NAPI_MODULE_INIT() {
  static const struct addon_function functions[] = {{"notify", notify}};
  return EXPORT_FUNCTIONS(env, exports, functions) ? exports : NULL;
}
