#include "values.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>

napi_value fail(napi_env env, const char *code, int64_t number) {
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

napi_value fail_errno(napi_env env, int error) { return fail(env, errno_name(error), error); }

napi_value fail_fault(napi_env env, int64_t fault) { return fault >= 0 ? fail(env, "FAULT", fault) : NULL; }

bool take_number(napi_env env, napi_value value, double *to) {
  if (napi_get_value_double(env, value, to) == napi_ok) return true;
  return refuse(env, "not a number");
}

bool take_size(napi_env env, napi_value value, size_t *to) {
  double given = 0;
  if (!take_number(env, value, &given)) return false;
  if (given >= 0 && given <= 9007199254740991.0 && given == (double)(uint64_t)given) {
    *to = (size_t)given;
    return true;
  }
  napi_throw_range_error(env, "RANGE", "not a size");
  return false;
}

bool take_word(napi_env env, napi_value value, uint32_t *to) {
  if (napi_get_value_uint32(env, value, to) == napi_ok) return true;
  return refuse(env, "not a number");
}

bool take_bytes(napi_env env, napi_value value, struct bytes *to) {
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
  return refuse(env, "not a typed array");
}
