/*
 * udpPort(fd): the local port of a bound UDP socket, 0 for anything else. knowsSegments(fd): whether the kernel can cut
 * one message into datagrams.
 *
 * send(fd, address, port, bytes, lengths, count, segments): sends the first `count` datagrams, which lie in `bytes` one
 * after the other. Returns how many the kernel took, plus 65536 times an `enum stop`: why it took no more. Never blocks,
 * and throws only for a mistake of the caller.
 */
#include <farpoint_addon.h>

#include "batch.h"

/* An IPv6 address, %, and the name of an interface. */
enum { MOST_ADDRESS = 80 };
enum { STOP_UNIT = 65536 };

static bool take_uint32(napi_env env, napi_value value, const char *what, uint32_t *to) {
  double number = 0;
  if (napi_get_value_double(env, value, &number) != napi_ok || !(number >= 0 && number <= INT32_MAX) ||
      number != (double)(uint32_t)number) {
    return refuse(env, what);
  }
  *to = (uint32_t)number;
  return true;
}

/* `length` in elements. */
static bool take_array(napi_env env, napi_value value, napi_typedarray_type wanted, const char *what, void **to,
                       size_t *length) {
  napi_typedarray_type type = napi_int8_array;
  bool is_array = false;
  if (napi_is_typedarray(env, value, &is_array) == napi_ok && is_array &&
      napi_get_typedarray_info(env, value, &type, length, to, NULL, NULL) == napi_ok && type == wanted) {
    return true;
  }
  return refuse(env, what);
}

static bool lie_within(const uint32_t *lengths, uint32_t count, size_t room) {
  size_t sum = 0;
  for (uint32_t i = 0; i < count; i++) {
    if (lengths[i] > room - sum) return false;
    sum += lengths[i];
  }
  return true;
}

static bool take_descriptor(napi_env env, napi_callback_info info, uint32_t *fd) {
  napi_value values[MOST_ARGUMENTS];
  return take_arguments(env, info, 1, values) && take_uint32(env, values[0], "not a descriptor", fd);
}

static napi_value js_udp_port(napi_env env, napi_callback_info info) {
  uint32_t fd = 0;
  napi_value port = NULL;
  if (take_descriptor(env, info, &fd)) napi_create_uint32(env, udp_port((int)fd), &port);
  return port;
}

static napi_value js_knows_segments(napi_env env, napi_callback_info info) {
  uint32_t fd = 0;
  napi_value known = NULL;
  if (take_descriptor(env, info, &fd)) napi_get_boolean(env, knows_segments((int)fd), &known);
  return known;
}

static napi_value js_send(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS], result = NULL;
  uint32_t fd = 0, port = 0, count = 0;
  char address[MOST_ADDRESS];
  void *bytes = NULL, *lengths = NULL;
  size_t room = 0, listed = 0;
  bool segments = false;
  if (!take_arguments(env, info, 7, values) || !take_uint32(env, values[0], "not a descriptor", &fd)) return NULL;
  if (!read_text(env, values[1], address, sizeof address)) {
    refuse(env, "not an address");
    return NULL;
  }
  if (!take_uint32(env, values[2], "not a port", &port) ||
      !take_array(env, values[3], napi_uint8_array, "bytes are no Uint8Array", &bytes, &room) ||
      !take_array(env, values[4], napi_uint32_array, "lengths are no Uint32Array", &lengths, &listed) ||
      !take_uint32(env, values[5], "not a number of datagrams", &count) || !take_bool(env, values[6], &segments)) {
    return NULL;
  }
  if (count > MOST_DATAGRAMS || count > listed || !lie_within(lengths, count, room)) {
    refuse(env, "more than there are");
    return NULL;
  }
  struct destination to;
  struct sending sending = {.sent = 0, .stop = STOP_REFUSED};
  if (parse_destination(address, port, &to)) sending = send_datagrams((int)fd, &to, bytes, lengths, count, segments);
  napi_create_uint32(env, sending.sent + STOP_UNIT * (uint32_t)sending.stop, &result);
  return result;
}

NAPI_MODULE_INIT() {
  static const struct addon_function functions[] = {
      {"udpPort", js_udp_port}, {"knowsSegments", js_knows_segments}, {"send", js_send}};
  return EXPORT_FUNCTIONS(env, exports, functions) ? exports : NULL;
}
