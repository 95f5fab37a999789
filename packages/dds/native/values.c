#include "values.h"

napi_value fail(napi_env env, const char *code, const char *message) {
  napi_throw_error(env, code, message);
  return NULL;
}

bool take_word(napi_env env, napi_value value, uint32_t least, uint32_t most, uint32_t *to) {
  double given = 0;
  if (napi_get_value_double(env, value, &given) != napi_ok || !(given >= least && given <= most) ||
      given != (double)(uint32_t)given) {
    return refuse(env, "not a number within its range");
  }
  *to = (uint32_t)given;
  return true;
}

bool take_text(napi_env env, napi_value value, char *to, size_t room) {
  return read_text(env, value, to, room) || refuse(env, "not a text, or too long");
}

static bool take_array(napi_env env, napi_value value, napi_typedarray_type wanted, size_t *length, void **data) {
  napi_typedarray_type type;
  bool is_array = false;
  if (napi_is_typedarray(env, value, &is_array) == napi_ok && is_array &&
      napi_get_typedarray_info(env, value, &type, length, data, NULL, NULL) == napi_ok && type == wanted) {
    return true;
  }
  return refuse(env, "not an array of this kind");
}

bool take_bytes(napi_env env, napi_value value, struct bytes *to) {
  void *data = NULL;
  if (!take_array(env, value, napi_uint8_array, &to->count, &data)) return false;
  to->at = data;
  return true;
}

bool take_doubles(napi_env env, napi_value value, size_t count, double **to) {
  void *data = NULL;
  size_t length = 0;
  if (!take_array(env, value, napi_float64_array, &length, &data)) return false;
  if (length < count) return refuse(env, "too short an array");
  *to = data;
  return true;
}
