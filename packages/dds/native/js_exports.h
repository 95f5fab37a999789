/* The addon's exports, by concept. Each returns whether it succeeded. */
#ifndef FARPOINT_JS_EXPORTS_H
#define FARPOINT_JS_EXPORTS_H

#include <farpoint_addon.h>

bool export_graph(napi_env env, napi_value exports);
bool export_reader(napi_env env, napi_value exports);
bool export_writer(napi_env env, napi_value exports);

#endif
