/*
 * The DDS addon: participants, readers, writers and discovery data. TypeScript decides names, QoS and bytes; see
 * src/addon.ts.
 */
#include "js_exports.h"
#include "log.h"

NAPI_MODULE_INIT() {
  log_install();
  const bool exported = export_graph(env, exports) && export_reader(env, exports) && export_writer(env, exports);
  return exported ? exports : NULL;
}
