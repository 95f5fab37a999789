/* The reference system's command block for JavaScript. */
#include "control.h"

#include <stdlib.h>
#include <string.h>

#include "js_exports.h"
#include "js_mapping.h"

static const napi_type_tag CONTROL_TAG = {0x2d94c6e8f13b7a50, 0xe6b8053fc7a1d924};

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

static bool take_control(napi_env env, napi_value value, struct control **to) {
  void *data = NULL;
  if (!take_handle(env, value, &CONTROL_TAG, &data)) return false;
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
  if (!take_arguments(env, info, 3, values) || !take_mapping(env, values[0], &block) ||
      !take_mapping(env, values[1], &busy) || !check_writable(env, block) || !check_writable(env, busy) ||
      !take_word(env, values[2], &silence_ms)) {
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
  if (!take_arguments(env, info, 2, values) || !take_control(env, values[0], &control) ||
      !take_bytes(env, values[1], &bytes)) {
    return NULL;
  }
  if (bytes.count != sizeof velocity) return fail(env, "RANGE", (int64_t)bytes.count);
  memcpy(velocity, bytes.at, sizeof velocity);
  const int64_t fault = control_write(control, velocity, &counter);
  if (fault >= 0) return fail_fault(env, fault);
  napi_create_int32(env, counter, &result);
  return result;
}

static napi_value js_control_silences(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct control *control;
  if (!take_arguments(env, info, 1, values) || !take_control(env, values[0], &control)) return NULL;
  napi_create_uint32(env, control_silences(control), &result);
  return result;
}

static napi_value js_control_close(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  void *data = NULL;
  if (!take_arguments(env, info, 1, values) || !take_handle(env, values[0], &CONTROL_TAG, &data)) return NULL;
  struct control_handle *handle = data;
  if (handle->control != NULL) {
    napi_remove_env_cleanup_hook(env, stop_control, handle);
    stop_control(handle);
  }
  return NULL;
}

bool export_control(napi_env env, napi_value exports) {
  static const struct addon_function functions[] = {
      {"control", js_control},
      {"controlWrite", js_control_write},
      {"controlSilences", js_control_silences},
      {"controlClose", js_control_close},
  };
  return EXPORT_FUNCTIONS(env, exports, functions);
}
