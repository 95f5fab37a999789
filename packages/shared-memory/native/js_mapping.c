/* Mapped files for JavaScript. */
#include "js_mapping.h"

#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "js_exports.h"

static const napi_type_tag MAPPING_TAG = {0x8f6d2a9c41b7e053, 0x1c90e7d24fa86b35};

enum { MOST_PATH = 4096 };

struct mapping_handle {
  struct mapping *mapping;
};

static void finalize_mapping(napi_env env, void *data, void *hint) {
  struct mapping_handle *handle = data;
  if (handle->mapping != NULL) mapping_release(handle->mapping);
  free(handle);
}

bool take_mapping(napi_env env, napi_value value, struct mapping **to) {
  void *data = NULL;
  if (!take_handle(env, value, &MAPPING_TAG, &data)) return false;
  *to = ((struct mapping_handle *)data)->mapping;
  if (*to != NULL) return true;
  fail(env, "CLOSED", 0);
  return false;
}

bool take_range(napi_env env, struct mapping *mapping, napi_value value, size_t align, size_t count, size_t *to) {
  if (!take_size(env, value, to)) return false;
  if (*to <= mapping->bytes && count <= mapping->bytes - *to && *to % align == 0) return true;
  fail(env, "RANGE", (int64_t)*to);
  return false;
}

bool check_writable(napi_env env, struct mapping *mapping) {
  if (mapping->writable) return true;
  fail(env, "EACCES", 0);
  return false;
}

/* open(path, writable, create, exclusive, resize, bytes, mode, owner, anyOwner) */
static napi_value js_open(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  if (!take_arguments(env, info, 9, values)) return NULL;
  char path[MOST_PATH];
  if (!read_text(env, values[0], path, sizeof path)) {
    refuse(env, "not a path");
    return NULL;
  }
  struct open_request request = {.path = path};
  uint32_t mode = 0;
  if (!take_bool(env, values[1], &request.writable) || !take_bool(env, values[2], &request.create) ||
      !take_bool(env, values[3], &request.exclusive) || !take_bool(env, values[4], &request.resize) ||
      !take_size(env, values[5], &request.bytes) || !take_word(env, values[6], &mode) ||
      !take_word(env, values[7], &request.owner) || !take_bool(env, values[8], &request.any_owner)) {
    return NULL;
  }
  request.mode = mode & 0660;
  struct mapping *mapping = NULL;
  int64_t detail = 0;
  switch (mapping_open(&request, &mapping, &detail)) {
    case OPEN_OK: break;
    case OPEN_ERRNO: return fail_errno(env, (int)detail);
    case OPEN_NOT_A_FILE: return fail(env, "FILE", 0);
    case OPEN_WORLD_WRITABLE: return fail(env, "UNSAFE", detail);
    case OPEN_FOREIGN: return fail(env, "OWNER", detail);
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
  if (!take_arguments(env, info, 1, values) || !take_handle(env, values[0], &MAPPING_TAG, &data)) return NULL;
  struct mapping_handle *handle = data;
  if (handle->mapping != NULL) mapping_release(handle->mapping);
  handle->mapping = NULL;
  return NULL;
}

static napi_value js_size(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct mapping *mapping;
  if (!take_arguments(env, info, 1, values) || !take_mapping(env, values[0], &mapping)) return NULL;
  napi_create_double(env, (double)mapping->bytes, &result);
  return result;
}

/* Whether the path still leads to the mapped file, and the file still has its size: current(handle) */
static napi_value js_current(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct mapping *mapping;
  struct stat status;
  if (!take_arguments(env, info, 1, values) || !take_mapping(env, values[0], &mapping)) return NULL;
  const bool current =
      fstat(mapping->fd, &status) == 0 && status.st_nlink > 0 && (size_t)status.st_size == mapping->bytes;
  napi_get_boolean(env, current, &result);
  return result;
}

/* Locks the file until the mapping is closed; returns whether nobody else holds the lock: lock(handle) */
static napi_value js_lock(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct mapping *mapping;
  if (!take_arguments(env, info, 1, values) || !take_mapping(env, values[0], &mapping)) return NULL;
  napi_get_boolean(env, flock(mapping->fd, LOCK_EX | LOCK_NB) == 0, &result);
  return result;
}

static napi_value load(napi_env env, napi_callback_info info, size_t width) {
  napi_value values[MOST_ARGUMENTS];
  napi_value result;
  struct mapping *mapping;
  size_t offset;
  uint32_t value = 0;
  if (!take_arguments(env, info, 2, values) || !take_mapping(env, values[0], &mapping) ||
      !take_range(env, mapping, values[1], width, width, &offset)) {
    return NULL;
  }
  const int64_t fault =
      width == 1 ? mapping_load8(mapping, offset, &value) : mapping_load32(mapping, offset, &value);
  if (fault >= 0) return fail_fault(env, fault);
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
  if (!take_arguments(env, info, 3, values) || !take_mapping(env, values[0], &mapping) || !check_writable(env, mapping) ||
      !take_range(env, mapping, values[1], width, width, &offset) || !take_word(env, values[2], &value)) {
    return NULL;
  }
  return fail_fault(env, width == 1 ? mapping_store8(mapping, offset, (uint8_t)value)
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
  if (!take_arguments(env, info, 3, values) || !take_mapping(env, values[0], &mapping) ||
      (!out && !check_writable(env, mapping)) || !take_bytes(env, values[2], &bytes) ||
      !take_range(env, mapping, values[1], 1, bytes.count, &offset)) {
    return NULL;
  }
  if (bytes.count == 0) return NULL;
  return fail_fault(env, out ? mapping_copy_out(mapping, offset, bytes.at, bytes.count)
                          : mapping_copy_in(mapping, offset, bytes.at, bytes.count));
}

static napi_value js_copy_out(napi_env env, napi_callback_info info) { return copy(env, info, true); }
static napi_value js_copy_in(napi_env env, napi_callback_info info) { return copy(env, info, false); }

static napi_value js_wake(napi_env env, napi_callback_info info) {
  napi_value values[MOST_ARGUMENTS];
  struct mapping *mapping;
  size_t offset;
  if (!take_arguments(env, info, 2, values) || !take_mapping(env, values[0], &mapping) ||
      !take_range(env, mapping, values[1], 4, 4, &offset)) {
    return NULL;
  }
  mapping_wake(mapping, offset);
  return NULL;
}

bool export_mapping(napi_env env, napi_value exports) {
  static const struct addon_function functions[] = {
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
  };
  return EXPORT_FUNCTIONS(env, exports, functions);
}
