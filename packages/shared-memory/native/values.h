/* Converts values from and to JavaScript, with checks. Each function that fails has thrown. */
#ifndef FARPOINT_VALUES_H
#define FARPOINT_VALUES_H

#include <farpoint_addon.h>
#include <stdint.h>

struct bytes {
  uint8_t *at;
  size_t count;
};

/*
 * Throws an error with a code (an errno name, or one of CLOSED, RANGE, FAULT, UNSAFE, OWNER, SIZE, FILE) and, as its message,
 * the number that belongs to it: see src/addon.ts. Returns NULL.
 */
napi_value fail(napi_env env, const char *code, int64_t number);
/* The same for an errno. */
napi_value fail_errno(napi_env env, int error);
/* The same for a fault at this offset; -1 means no fault and throws nothing. */
napi_value fail_fault(napi_env env, int64_t fault);

bool take_number(napi_env env, napi_value value, double *to);
bool take_size(napi_env env, napi_value value, size_t *to);
bool take_word(napi_env env, napi_value value, uint32_t *to);
/* Of a typed array of any kind, but not of a detached one. */
bool take_bytes(napi_env env, napi_value value, struct bytes *to);

#endif
