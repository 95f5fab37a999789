/*
 * What the addons share at the border to JavaScript: checked arguments, handles, callbacks, and the table of exports.
 * Each function that fails has thrown a TypeError with the code RANGE, a mistake of the caller, unless stated
 * otherwise.
 */
#ifndef FARPOINT_ADDON_H
#define FARPOINT_ADDON_H

#include <node_api.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

enum { MOST_ARGUMENTS = 12 };

/* Returns false. */
static inline bool refuse(napi_env env, const char *message) {
  napi_throw_type_error(env, "RANGE", message);
  return false;
}

/* `values` has room for MOST_ARGUMENTS; further arguments are ignored. */
static inline bool take_arguments(napi_env env, napi_callback_info info, size_t wanted, napi_value *values) {
  size_t count = MOST_ARGUMENTS;
  if (napi_get_cb_info(env, info, &count, values, NULL, NULL) == napi_ok && count >= wanted) return true;
  return refuse(env, "too few arguments");
}

static inline bool take_bool(napi_env env, napi_value value, bool *to) {
  return napi_get_value_bool(env, value, to) == napi_ok || refuse(env, "not a boolean");
}

/* Zero-terminated. Refuses texts that contain a zero or do not fit. Throws nothing. */
static inline bool read_text(napi_env env, napi_value value, char *to, size_t room) {
  size_t length = 0;
  return napi_get_value_string_utf8(env, value, to, room, &length) == napi_ok && length < room - 1 &&
         strlen(to) == length;
}

/* The thing that an object with this tag wraps. */
static inline bool take_handle(napi_env env, napi_value value, const napi_type_tag *tag, void **to) {
  bool right = false;
  if (napi_check_object_type_tag(env, value, tag, &right) == napi_ok && right &&
      napi_unwrap(env, value, to) == napi_ok) {
    return true;
  }
  return refuse(env, "not a handle of this kind");
}

/* Call it from a thread-safe function. As in any callback, an uncaught error ends the process. */
static inline void call_back(napi_env env, napi_value callback, size_t count, const napi_value *arguments) {
  napi_value self, error;
  napi_get_undefined(env, &self);
  if (napi_call_function(env, self, callback, count, arguments, NULL) != napi_pending_exception) return;
  napi_get_and_clear_last_exception(env, &error);
  napi_fatal_exception(env, error);
}

struct addon_function {
  const char *name;
  napi_callback call;
};

/* Returns whether all of them could be created; otherwise an error may be pending. */
static inline bool export_functions(napi_env env, napi_value exports, const struct addon_function *functions,
                                    size_t count) {
  for (size_t i = 0; i < count; i++) {
    napi_value value;
    if (napi_create_function(env, functions[i].name, NAPI_AUTO_LENGTH, functions[i].call, NULL, &value) != napi_ok ||
        napi_set_named_property(env, exports, functions[i].name, value) != napi_ok) {
      return false;
    }
  }
  return true;
}

/* `functions` is an array. */
#define EXPORT_FUNCTIONS(env, exports, functions) \
  export_functions(env, exports, functions, sizeof(functions) / sizeof((functions)[0]))

#endif
