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
};

/* From graph, topic, type, reliable, transientLocal, depth. Has thrown on failure. */
bool take_request(napi_env env, napi_value *values, struct request *to);

#endif
