/* Watches for JavaScript: one callback for each order. */
#include "watch.h"

#include <stdlib.h>

#include "js_exports.h"
#include "js_mapping.h"

static const napi_type_tag WATCH_TAG = {0x5be1704fd8c2963a, 0x77a3c19d0e4f8b62};

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
  napi_value outcome;
  napi_create_int32(env, (int32_t)(intptr_t)data, &outcome);
  call_back(env, callback, 1, &outcome);
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
  if (!take_arguments(env, info, 4, values) || !take_mapping(env, values[0], &mapping)) return NULL;
  if (napi_get_value_bool(env, values[2], &place.futex) != napi_ok) return fail(env, "RANGE", 0);
  const size_t width = place.futex ? 4 : 1;
  if (!take_range(env, mapping, values[1], width, width, &place.offset)) return NULL;
  struct watch_handle *handle = calloc(1, sizeof *handle);
  if (handle == NULL) return fail(env, "ENOMEM", 0);
  handle->env = env;
  napi_create_string_utf8(env, "farpoint-watch", NAPI_AUTO_LENGTH, &name);
  if (napi_create_threadsafe_function(env, values[3], NULL, name, 0, 1, NULL, NULL, handle, call_js,
                                      &handle->callback) != napi_ok) {
    free(handle);
    return fail(env, "RANGE", 0);
  }
  /* A program that only waits for frames may exit. */
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
  if (!take_arguments(env, info, 5, values) || !take_handle(env, values[0], &WATCH_TAG, &data) ||
      !take_word(env, values[1], &order.value) || !take_word(env, values[2], &order.quiet_us) ||
      !take_word(env, values[3], &order.poll_us) || !take_word(env, values[4], &order.timeout_ms)) {
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
  if (!take_arguments(env, info, 1, values) || !take_handle(env, values[0], &WATCH_TAG, &data)) return NULL;
  struct watch_handle *handle = data;
  if (handle->watch != NULL) {
    napi_remove_env_cleanup_hook(env, stop_watch, handle);
    stop_watch(handle);
  }
  return NULL;
}

bool export_watch(napi_env env, napi_value exports) {
  static const struct addon_function functions[] = {
      {"watch", js_watch},
      {"arm", js_arm},
      {"unwatch", js_unwatch},
  };
  return EXPORT_FUNCTIONS(env, exports, functions);
}
