/* The addon's exports, by concept. Each returns whether it succeeded. */
#ifndef FARPOINT_JS_EXPORTS_H
#define FARPOINT_JS_EXPORTS_H

#include <farpoint_addon.h>

bool export_mapping(napi_env env, napi_value exports);
bool export_decode(napi_env env, napi_value exports);
bool export_watch(napi_env env, napi_value exports);
bool export_control(napi_env env, napi_value exports);

#endif
