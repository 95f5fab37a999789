/*
 * Node-API surface of the shared-memory addon: guarded access to mapped files, and threads that wait. What the bytes mean
 * is decided in TypeScript; nothing here knows a layout but the two decoders.
 *
 * Errors are thrown with a code (an errno name, or one of CLOSED, RANGE, FAULT, UNSAFE, SIZE, FILE) and, as message, the
 * number that belongs to it: see src/addon.ts.
 */
#include <errno.h>
#include <inttypes.h>
#include <node_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "control.h"
#include "decode.h"
#include "guard.h"
#include "mapping.h"
#include "watch.h"

static const napi_type_tag MAPPING_TAG = {0x8f6d2a9c41b7e053, 0x1c90e7d24fa86b35};
static const napi_type_tag WATCH_TAG = {0x5be1704fd8c2963a, 0x77a3c19d0e4f8b62};
static const napi_type_tag CONTROL_TAG = {0x2d94c6e8f13b7a50, 0xe6b8053fc7a1d924};

enum { MOST_ARGUMENTS = 12, MOST_PATH = 4096 };

static napi_value fail(napi_env env, const char *code, int64_t number) {
  char text[32];
  snprintf(text, sizeof text, "%" PRId64, number);
  napi_throw_error(env, code, text);
  return NULL;
}

static const char *errno_name(int error) {
  switch (error) {
    case ENOENT: return "ENOENT";
    case EACCES: return "EACCES";
    case EPERM: return "EPERM";
    case EEXIST: return "EEXIST";
    case ELOOP: return "ELOOP";
    case EISDIR: return "EISDIR";
    case ENOTDIR: return "ENOTDIR";
    case ENOSPC: return "ENOSPC";
    case ENOMEM: return "ENOMEM";
    case EROFS: return "EROFS";
    case EMFILE: return "EMFILE";
    default: return "EIO";
  }
}

/* Arguments */

static bool arguments(napi_env env, napi_callback_info info, size_t wanted, napi_value *values) {
  size_t count = MOST_ARGUMENTS;
  if (napi_get_cb_info(env, info, &count, values, NULL, NULL) == napi_ok && count >= wanted) return true;
  napi_throw_type_error(env, "RANGE", "too few arguments");
  return false;
}

static bool number(napi_env env, napi_value value, double *to) {
  if (napi_get_value_double(env, value, to) == napi_ok) return true;
  napi_throw_type_error(env, "RANGE", "not a number");
  return false;
}

static bool offset_of(napi_env env, napi_value value, size_t *to) {
  double given = 0;
  if (!number(env, value, &given)) return false;
  if (given >= 0 && given <= 9007199254740991.0 && given == (double)(uint64_t)given) {
    *to = (size_t)given;
    return true;
  }
  napi_throw_range_error(env, "RANGE", "not a size");
  return false;
}

static bool word(napi_env env, napi_value value, uint32_t *to) {
  if (napi_get_value_uint32(env, value, to) == napi_ok) return true;
  napi_throw_type_error(env, "RANGE", "not a number");
  return false;
}

static bool unwrap(napi_env env, napi_value value, const napi_type_tag *tag, void **to) {
  bool right = false;
  if (napi_check_object_type_tag(env, value, tag, &right) == napi_ok && right &&
      napi_unwrap(env, value, to) == napi_ok) {
    return true;
  }
  napi_throw_type_error(env, "RANGE", "not a handle of this kind");
  return false;
}

struct bytes {
  uint8_t *at;
  size_t count;
};

/* Of a typed array; not of a detached one. */
static bool bytes_of(napi_env env, napi_value value, struct bytes *to) {
  static const size_t sizes[] = {1, 1, 1, 2, 2, 4, 4, 4, 8, 8, 8};
  napi_typedarray_type type;
  size_t length = 0;
  void *data = NULL;
  bool is_array = false;
  if (napi_is_typedarray(env, value, &is_array) == napi_ok && is_array &&
      napi_get_typedarray_info(env, value, &type, &length, &data, NULL, NULL) == napi_ok && (size_t)type < 11) {
    to->at = data;
    to->count = length * sizes[type];
    return true;
  }
  napi_throw_type_error(env, "RANGE", "not a typed array");
  return false;
}

/* Mappings */

struct mapping_handle {
  struct mapping *mapping;
};

static void finalize_mapping(napi_env env, void *data, void *hint) {
  struct mapping_handle *handle = data;
  if (handle->mapping != NULL) mapping_release(handle->mapping);
  free(handle);
}

static bool mapping_of(napi_env env, napi_value value, struct mapping **to) {
  void *data = NULL;
  if (!unwrap(env, value, &MAPPING_TAG, &data)) return false;
  *to = ((struct mapping_handle *)data)->mapping;
  if (*to != NULL) return true;
  fail(env, "CLOSED", 0);
  return false;
}

/* That `count` bytes at an offset lie in the mapping, the offset being a multiple of `align`. */
static bool range_of(napi_env env, struct mapping *mapping, napi_value value, size_t align, size_t count, size_t *to) {
  if (!offset_of(env, value, to)) return false;
  if (*to <= mapping->bytes && count <= mapping->bytes - *to && *to % align == 0) return true;
  fail(env, "RANGE", (int64_t)*to);
  return false;
}

static bool writable(napi_env env, struct mapping *mapping) {
  if (mapping->writable) return true;
  fail(env, "EACCES", 0);
  return false;
}

static napi_value nothing(napi_env env, int64_t fault) {
  return fault >= 0 ? fail(env, "FAULT", fault) : NULL;
}

/* open(path, writable, create, exclusive, resize, bytes, mode) */
static napi_value js_open(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  if (!arguments(env, info, 7, values)) return NULL;
  char path[MOST_PATH];
  size_t length = 0;
  if (napi_get_value_string_utf8(env, values[0], path, sizeof path, &length) != napi_ok ||
      length >= sizeof path - 1 || strlen(path) != length) {
    napi_throw_type_error(env, "RANGE", "not a path");
    return NULL;
  }
  struct open_request request = {.path = path};
  uint32_t mode = 0;
  if (napi_get_value_bool(env, values[1], &request.writable) != napi_ok ||
      napi_get_value_bool(env, values[2], &request.create) != napi_ok ||
      napi_get_value_bool(env, values[3], &request.exclusive) != napi_ok ||
      napi_get_value_bool(env, values[4], &request.resize) != napi_ok) {
    napi_throw_type_error(env, "RANGE", "not a boolean");
    return NULL;
  }
  if (!offset_of(env, values[5], &request.bytes) || !word(env, values[6], &mode)) return NULL;
  request.mode = mode & 0660;
  struct mapping *mapping = NULL;
  int64_t detail = 0;
  switch (mapping_open(&request, &mapping, &detail)) {
    case OPEN_OK: break;
    case OPEN_ERRNO: return fail(env, errno_name((int)detail), detail);
    case OPEN_NOT_A_FILE: return fail(env, "FILE", 0);
    case OPEN_WORLD_WRITABLE: return fail(env, "UNSAFE", detail);
    case OPEN_WRONG_SIZE: return fail(env, "SIZE", detail);
  }
  struct mapping_handle *handle = calloc(1, sizeof *handle);
  napi_value object;
  if (handle == NULL || napi_create_object(env, &object) != napi_ok ||
      napi_wrap(env, object, handle, finalize_mapping, NULL, NULL) != napi_ok) {
    free(handle);
    mapping_release(mapping);
    return fail(env, "ENOMEM", 0);
  }
  handle->mapping = mapping;
  napi_type_tag_object(env, object, &MAPPING_TAG);
  return object;
}

static napi_value js_close(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  void *data = NULL;
  if (!arguments(env, info, 1, values) || !unwrap(env, values[0], &MAPPING_TAG, &data)) return NULL;
  struct mapping_handle *handle = data;
  if (handle->mapping != NULL) mapping_release(handle->mapping);
  handle->mapping = NULL;
  return NULL;
}

static napi_value js_size(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct mapping *mapping;
  if (!arguments(env, info, 1, values) || !mapping_of(env, values[0], &mapping)) return NULL;
  napi_create_double(env, (double)mapping->bytes, &result);
  return result;
}

/* Whether the path still leads to the mapped file, and that still has its size: current(handle) */
static napi_value js_current(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct mapping *mapping;
  struct stat status;
  if (!arguments(env, info, 1, values) || !mapping_of(env, values[0], &mapping)) return NULL;
  const bool current =
      fstat(mapping->fd, &status) == 0 && status.st_nlink > 0 && (size_t)status.st_size == mapping->bytes;
  napi_get_boolean(env, current, &result);
  return result;
}

/* Whether nobody else holds the file's lock; it is ours until the mapping is closed: lock(handle) */
static napi_value js_lock(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct mapping *mapping;
  if (!arguments(env, info, 1, values) || !mapping_of(env, values[0], &mapping)) return NULL;
  napi_get_boolean(env, flock(mapping->fd, LOCK_EX | LOCK_NB) == 0, &result);
  return result;
}

static napi_value load(napi_env env, napi_callback_info info, size_t width) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct mapping *mapping;
  size_t offset;
  uint32_t value = 0;
  if (!arguments(env, info, 2, values) || !mapping_of(env, values[0], &mapping) ||
      !range_of(env, mapping, values[1], width, width, &offset)) {
    return NULL;
  }
  const int64_t fault =
      width == 1 ? mapping_load8(mapping, offset, &value) : mapping_load32(mapping, offset, &value);
  if (fault >= 0) return fail(env, "FAULT", fault);
  napi_create_uint32(env, value, &result);
  return result;
}

static napi_value js_load8(napi_env env, napi_callback_info info) { return load(env, info, 1); }
static napi_value js_load32(napi_env env, napi_callback_info info) { return load(env, info, 4); }

static napi_value store(napi_env env, napi_callback_info info, size_t width) {
  napi_value values[MOST_ARGUMENTS];
  struct mapping *mapping;
  size_t offset;
  uint32_t value;
  if (!arguments(env, info, 3, values) || !mapping_of(env, values[0], &mapping) || !writable(env, mapping) ||
      !range_of(env, mapping, values[1], width, width, &offset) || !word(env, values[2], &value)) {
    return NULL;
  }
  return nothing(env, width == 1 ? mapping_store8(mapping, offset, (uint8_t)value)
                                 : mapping_store32(mapping, offset, value));
}

static napi_value js_store8(napi_env env, napi_callback_info info) { return store(env, info, 1); }
static napi_value js_store32(napi_env env, napi_callback_info info) { return store(env, info, 4); }

static napi_value js_fence(napi_env env, napi_callback_info info) {
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  return NULL;
}

static napi_value copy(napi_env env, napi_callback_info info, bool out) {
  napi_value values[MOST_ARGUMENTS];
  struct mapping *mapping;
  struct bytes bytes;
  size_t offset;
  if (!arguments(env, info, 3, values) || !mapping_of(env, values[0], &mapping) ||
      (!out && !writable(env, mapping)) || !bytes_of(env, values[2], &bytes) ||
      !range_of(env, mapping, values[1], 1, bytes.count, &offset)) {
    return NULL;
  }
  if (bytes.count == 0) return NULL;
  return nothing(env, out ? mapping_copy_out(mapping, offset, bytes.at, bytes.count)
                          : mapping_copy_in(mapping, offset, bytes.at, bytes.count));
}

static napi_value js_copy_out(napi_env env, napi_callback_info info) { return copy(env, info, true); }
static napi_value js_copy_in(napi_env env, napi_callback_info info) { return copy(env, info, false); }

static napi_value js_wake(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  struct mapping *mapping;
  size_t offset;
  if (!arguments(env, info, 2, values) || !mapping_of(env, values[0], &mapping) ||
      !range_of(env, mapping, values[1], 4, 4, &offset)) {
    return NULL;
  }
  mapping_wake(mapping, offset);
  return NULL;
}

/* unpackPoints64(handle, offset, bytes, to): whether every point is green */
static napi_value js_unpack_points64(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct mapping *mapping;
  struct bytes to;
  size_t offset, count;
  if (!arguments(env, info, 4, values) || !mapping_of(env, values[0], &mapping) ||
      !offset_of(env, values[2], &count) || !range_of(env, mapping, values[1], 1, count, &offset) ||
      !bytes_of(env, values[3], &to)) {
    return NULL;
  }
  if (count % 8 != 0 || to.count < count * 2 || (uintptr_t)to.at % 4 != 0) return fail(env, "RANGE", (int64_t)count);
  bool green = false;
  const int64_t fault = decode_points64(mapping, offset, count, (uint32_t *)(void *)to.at, &green);
  if (fault >= 0) return fail(env, "FAULT", fault);
  napi_get_boolean(env, green, &result);
  return result;
}

/* images(handle, kind, depthOffset, colourOffset, pixels, unit, depth, colour) */
static napi_value js_images(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  struct mapping *mapping;
  struct bytes depth, colour;
  struct depth_frame frame;
  uint32_t kind;
  double unit;
  if (!arguments(env, info, 8, values) || !mapping_of(env, values[0], &mapping) || !word(env, values[1], &kind) ||
      !offset_of(env, values[4], &frame.pixels) || !number(env, values[5], &unit) ||
      !bytes_of(env, values[6], &depth) || !bytes_of(env, values[7], &colour)) {
    return NULL;
  }
  /* More pixels than there is room for are refused before they are multiplied. */
  if (kind > DEPTH_32 || depth.count / 4 < frame.pixels || colour.count / 4 < frame.pixels ||
      (uintptr_t)depth.at % 4 != 0 || (uintptr_t)colour.at % 4 != 0) {
    return fail(env, "RANGE", (int64_t)frame.pixels);
  }
  frame.kind = (enum depth_kind)kind;
  frame.unit = (float)unit;
  const size_t depth_bytes = frame.pixels * (frame.kind == DEPTH_OF_POINTS ? 16 : frame.kind == DEPTH_16 ? 2 : 4);
  const size_t colour_bytes = frame.kind == DEPTH_OF_POINTS ? 0 : frame.pixels * 4;
  if (!range_of(env, mapping, values[2], 1, depth_bytes, &frame.depth) ||
      !range_of(env, mapping, values[3], 1, colour_bytes, &frame.colour)) {
    return NULL;
  }
  return nothing(env, decode_images(mapping, &frame, (float *)(void *)depth.at, (uint32_t *)(void *)colour.at));
}

/* Watches */

struct watch_handle {
  napi_env env;
  struct watch *watch;
  napi_threadsafe_function callback;
};

static void on_outcome(enum watch_outcome outcome, void *context) {
  struct watch_handle *handle = context;
  napi_call_threadsafe_function(handle->callback, (void *)(intptr_t)outcome, napi_tsfn_nonblocking);
}

static void call_js(napi_env env, napi_value callback, void *context, void *data) {
  if (env == NULL || callback == NULL) return;
  napi_value self, argument;
  napi_get_undefined(env, &self);
  napi_create_int32(env, (int32_t)(intptr_t)data, &argument);
  if (napi_call_function(env, self, callback, 1, &argument, NULL) != napi_pending_exception) return;
  /* As of any callback: an error that nobody catches ends the process. */
  napi_value error;
  napi_get_and_clear_last_exception(env, &error);
  napi_fatal_exception(env, error);
}

static void stop_watch(void *data) {
  struct watch_handle *handle = data;
  if (handle->watch == NULL) return;
  watch_stop(handle->watch);
  handle->watch = NULL;
  napi_release_threadsafe_function(handle->callback, napi_tsfn_abort);
}

static void finalize_watch(napi_env env, void *data, void *hint) {
  struct watch_handle *handle = data;
  if (handle->watch != NULL) {
    napi_remove_env_cleanup_hook(env, stop_watch, handle);
    stop_watch(handle);
  }
  free(handle);
}

/* watch(handle, offset, futex, callback) */
static napi_value js_watch(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  struct mapping *mapping;
  struct watch_place place;
  napi_value object, name;
  if (!arguments(env, info, 4, values) || !mapping_of(env, values[0], &mapping)) return NULL;
  if (napi_get_value_bool(env, values[2], &place.futex) != napi_ok) return fail(env, "RANGE", 0);
  const size_t width = place.futex ? 4 : 1;
  if (!range_of(env, mapping, values[1], width, width, &place.offset)) return NULL;
  struct watch_handle *handle = calloc(1, sizeof *handle);
  if (handle == NULL) return fail(env, "ENOMEM", 0);
  handle->env = env;
  napi_create_string_utf8(env, "farpoint-watch", NAPI_AUTO_LENGTH, &name);
  if (napi_create_threadsafe_function(env, values[3], NULL, name, 0, 1, NULL, NULL, handle, call_js,
                                      &handle->callback) != napi_ok) {
    free(handle);
    return fail(env, "RANGE", 0);
  }
  /* Whoever waits for frames alone may end. */
  napi_unref_threadsafe_function(env, handle->callback);
  handle->watch = watch_start(mapping, place, on_outcome, handle);
  if (handle->watch == NULL || napi_create_object(env, &object) != napi_ok ||
      napi_wrap(env, object, handle, finalize_watch, NULL, NULL) != napi_ok) {
    if (handle->watch != NULL) watch_stop(handle->watch);
    napi_release_threadsafe_function(handle->callback, napi_tsfn_abort);
    free(handle);
    return fail(env, "ENOMEM", 0);
  }
  napi_type_tag_object(env, object, &WATCH_TAG);
  napi_add_env_cleanup_hook(env, stop_watch, handle);
  return object;
}

/* arm(watch, value, quietUs, pollUs, timeoutMs) */
static napi_value js_arm(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  void *data = NULL;
  struct watch_order order;
  if (!arguments(env, info, 5, values) || !unwrap(env, values[0], &WATCH_TAG, &data) ||
      !word(env, values[1], &order.value) || !word(env, values[2], &order.quiet_us) ||
      !word(env, values[3], &order.poll_us) || !word(env, values[4], &order.timeout_ms)) {
    return NULL;
  }
  struct watch_handle *handle = data;
  if (handle->watch == NULL) return fail(env, "CLOSED", 0);
  watch_arm(handle->watch, order);
  return NULL;
}

static napi_value js_unwatch(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  void *data = NULL;
  if (!arguments(env, info, 1, values) || !unwrap(env, values[0], &WATCH_TAG, &data)) return NULL;
  struct watch_handle *handle = data;
  if (handle->watch != NULL) {
    napi_remove_env_cleanup_hook(env, stop_watch, handle);
    stop_watch(handle);
  }
  return NULL;
}

/* Command block */

struct control_handle {
  struct control *control;
};

static void stop_control(void *data) {
  struct control_handle *handle = data;
  if (handle->control == NULL) return;
  control_stop(handle->control);
  handle->control = NULL;
}

static void finalize_control(napi_env env, void *data, void *hint) {
  struct control_handle *handle = data;
  if (handle->control != NULL) {
    napi_remove_env_cleanup_hook(env, stop_control, handle);
    stop_control(handle);
  }
  free(handle);
}

static bool control_of(napi_env env, napi_value value, struct control **to) {
  void *data = NULL;
  if (!unwrap(env, value, &CONTROL_TAG, &data)) return false;
  *to = ((struct control_handle *)data)->control;
  if (*to != NULL) return true;
  fail(env, "CLOSED", 0);
  return false;
}

/* control(block, busy, silenceMs) */
static napi_value js_control(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  struct mapping *block, *busy;
  uint32_t silence_ms;
  napi_value object;
  if (!arguments(env, info, 3, values) || !mapping_of(env, values[0], &block) ||
      !mapping_of(env, values[1], &busy) || !writable(env, block) || !writable(env, busy) ||
      !word(env, values[2], &silence_ms)) {
    return NULL;
  }
  if (block->bytes < CONTROL_BYTES) return fail(env, "RANGE", (int64_t)block->bytes);
  struct control_handle *handle = calloc(1, sizeof *handle);
  if (handle == NULL) return fail(env, "ENOMEM", 0);
  handle->control = control_start(block, busy, silence_ms);
  if (handle->control == NULL || napi_create_object(env, &object) != napi_ok ||
      napi_wrap(env, object, handle, finalize_control, NULL, NULL) != napi_ok) {
    stop_control(handle);
    free(handle);
    return fail(env, "ENOMEM", 0);
  }
  napi_type_tag_object(env, object, &CONTROL_TAG);
  napi_add_env_cleanup_hook(env, stop_control, handle);
  return object;
}

/* controlWrite(control, [linear x, y, z, angular x, y, z]): the counter */
static napi_value js_control_write(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct control *control;
  struct bytes bytes;
  double velocity[CONTROL_VALUES];
  int32_t counter = 0;
  if (!arguments(env, info, 2, values) || !control_of(env, values[0], &control) ||
      !bytes_of(env, values[1], &bytes)) {
    return NULL;
  }
  if (bytes.count != sizeof velocity) return fail(env, "RANGE", (int64_t)bytes.count);
  memcpy(velocity, bytes.at, sizeof velocity);
  const int64_t fault = control_write(control, velocity, &counter);
  if (fault >= 0) return fail(env, "FAULT", fault);
  napi_create_int32(env, counter, &result);
  return result;
}

static napi_value js_control_silences(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct control *control;
  if (!arguments(env, info, 1, values) || !control_of(env, values[0], &control)) return NULL;
  napi_create_uint32(env, control_silences(control), &result);
  return result;
}

static napi_value js_control_close(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  void *data = NULL;
  if (!arguments(env, info, 1, values) || !unwrap(env, values[0], &CONTROL_TAG, &data)) return NULL;
  struct control_handle *handle = data;
  if (handle->control != NULL) {
    napi_remove_env_cleanup_hook(env, stop_control, handle);
    stop_control(handle);
  }
  return NULL;
}

NAPI_MODULE_INIT() {
  const int installed = guard_install();
  if (installed != 0) return fail(env, errno_name(installed), installed);
  const struct {
    const char *name;
    napi_callback call;
  } functions[] = {
      {"open", js_open},
      {"close", js_close},
      {"size", js_size},
      {"current", js_current},
      {"lock", js_lock},
      {"load8", js_load8},
      {"load32", js_load32},
      {"store8", js_store8},
      {"store32", js_store32},
      {"fence", js_fence},
      {"copyOut", js_copy_out},
      {"copyIn", js_copy_in},
      {"wake", js_wake},
      {"unpackPoints64", js_unpack_points64},
      {"images", js_images},
      {"watch", js_watch},
      {"arm", js_arm},
      {"unwatch", js_unwatch},
      {"control", js_control},
      {"controlWrite", js_control_write},
      {"controlSilences", js_control_silences},
      {"controlClose", js_control_close},
  };
  for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
    napi_value value;
    if (napi_create_function(env, functions[i].name, NAPI_AUTO_LENGTH, functions[i].call, NULL, &value) != napi_ok ||
        napi_set_named_property(env, exports, functions[i].name, value) != napi_ok) {
      return NULL;
    }
  }
  return exports;
}
