/* The reader or writer that JavaScript requests from a graph. */
#ifndef FARPOINT_JS_GRAPH_H
#define FARPOINT_JS_GRAPH_H

#include "graph.h"
#include "values.h"

struct request {
  struct graph *graph;
  char topic[MOST_NAME];
  char type[MOST_NAME];
  struct topic_quality quality;
  char user_data[MOST_NAME];
};

/* From graph, topic, type, reliable, transientLocal, depth, userData. Has thrown on failure. */
bool take_request(napi_env env, napi_value *values, struct request *to);

/* The endpoints that are matched with a writer or a reader: [guid, userData, guid, …]; a guid is 32 hexadecimal digits. */
napi_value list_matched(napi_env env, const struct endpoint *endpoint, bool is_writer);

#endif
