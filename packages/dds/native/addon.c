/*
 * The DDS addon: participants, readers, writers and what discovery sees. Names, qualities and bytes are decided in TypeScript;
 * see src/addon.ts.
 */
#include "js_exports.h"
#include "log.h"

NAPI_MODULE_INIT() {
  log_install();
  const bool exported = export_graph(env, exports) && export_reader(env, exports) && export_writer(env, exports);
  return exported ? exports : NULL;
}
