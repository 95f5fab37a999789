#include "graph.h"

#include <stdlib.h>
#include <string.h>

#include "domain.h"

/* Maximum number of publishers, or subscribers, that are read. */
enum { MOST_OTHERS = 4096 };

struct graph {
  struct domain *domain;
  dds_entity_t participant;
  dds_entity_t publications;
  dds_entity_t subscriptions;
  dds_guid_t guid;
  /* Used only by the program's thread, so without a lock. */
  unsigned users;
  void (*changed)(void *);
  void *context;
  /*
   * A reader keeps samples that it lent for reuse, and then fills as many as the first time: always pass the same
   * number.
   */
  void *samples[MOST_OTHERS];
  dds_sample_info_t infos[MOST_OTHERS];
};

static void on_discovery(dds_entity_t reader, void *argument) {
  struct graph *graph = argument;
  graph->changed(graph->context);
}

dds_return_t graph_open(dds_domainid_t id, const char *configuration, void (*changed)(void *), void *context,
                        struct graph **to) {
  struct graph *graph = calloc(1, sizeof *graph);
  if (graph == NULL) return DDS_RETCODE_OUT_OF_RESOURCES;
  graph->users = 1;
  graph->changed = changed;
  graph->context = context;
  dds_return_t result = domain_join(id, configuration, &graph->domain);
  if (result < 0) {
    free(graph);
    return result;
  }
  dds_listener_t *listener = dds_create_listener(graph);
  dds_lset_data_available(listener, on_discovery);
  if ((result = graph->participant = dds_create_participant(id, NULL, NULL)) >= 0 &&
      (result = dds_get_guid(graph->participant, &graph->guid)) >= 0 &&
      (result = graph->publications =
           dds_create_reader(graph->participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, NULL, listener)) >= 0) {
    result = graph->subscriptions =
        dds_create_reader(graph->participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, NULL, listener);
  }
  dds_delete_listener(listener);
  if (result < 0) {
    graph_close(graph);
    return result;
  }
  *to = graph;
  return DDS_RETCODE_OK;
}

static void release(struct graph *graph) {
  if (--graph->users > 0) return;
  if (graph->participant > 0) dds_delete(graph->participant);
  domain_leave(graph->domain);
  free(graph);
}

void graph_close(struct graph *graph) {
  /* Waits for running listeners. */
  if (graph->publications > 0) dds_delete(graph->publications);
  if (graph->subscriptions > 0) dds_delete(graph->subscriptions);
  release(graph);
}

static dds_qos_t *quality_of(struct topic_quality quality, bool writer) {
  static const dds_data_representation_id_t both[] = {DDS_DATA_REPRESENTATION_XCDR1, DDS_DATA_REPRESENTATION_XCDR2};
  dds_qos_t *qos = dds_create_qos();
  /* A writer must never block the program's thread. */
  dds_qset_reliability(qos, quality.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos, quality.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, quality.depth);
  /* Samples for late subscribers are limited by this, not by the history. */
  dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, quality.depth, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED);
  if (quality.user_data != NULL && quality.user_data[0] != '\0') {
    dds_qset_userdata(qos, quality.user_data, strlen(quality.user_data));
  }
  /* ROS 2 writes the first version of CDR; we do the same, and read both. */
  dds_qset_data_representation(qos, writer ? 1 : 2, both);
  return qos;
}

static dds_return_t create_topic(struct graph *graph, const char *topic, const char *name, struct endpoint *to) {
  struct ddsi_sertype *type = raw_type_new(name);
  if (type == NULL) return DDS_RETCODE_OUT_OF_RESOURCES;
  struct ddsi_sertype *used = type;
  to->topic = dds_create_topic_sertype(graph->participant, topic, &used, NULL, NULL, NULL);
  if (to->topic < 0) {
    ddsi_sertype_unref(type);
    return to->topic;
  }
  to->type = ddsi_sertype_ref(used);
  to->graph = graph;
  graph->users++;
  return DDS_RETCODE_OK;
}

static dds_return_t finish(struct endpoint *endpoint) {
  if (endpoint->entity >= 0) return DDS_RETCODE_OK;
  const dds_return_t failure = endpoint->entity;
  endpoint_delete(endpoint);
  return failure;
}

dds_return_t graph_reader(struct graph *graph, const char *topic, const char *type, struct topic_quality quality,
                          dds_listener_t *listener, struct endpoint *to) {
  const dds_return_t result = create_topic(graph, topic, type, to);
  if (result < 0) return result;
  dds_qos_t *qos = quality_of(quality, false);
  to->entity = dds_create_reader(graph->participant, to->topic, qos, listener);
  dds_delete_qos(qos);
  return finish(to);
}

dds_return_t graph_writer(struct graph *graph, const char *topic, const char *type, struct topic_quality quality,
                          struct endpoint *to) {
  const dds_return_t result = create_topic(graph, topic, type, to);
  if (result < 0) return result;
  dds_qos_t *qos = quality_of(quality, true);
  to->entity = dds_create_writer(graph->participant, to->topic, qos, NULL);
  dds_delete_qos(qos);
  return finish(to);
}

void endpoint_delete(struct endpoint *endpoint) {
  if (endpoint->entity > 0) dds_delete(endpoint->entity);
  dds_delete(endpoint->topic);
  ddsi_sertype_unref(endpoint->type);
  release(endpoint->graph);
}

static const uint32_t GONE = DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE | DDS_NOT_ALIVE_NO_WRITERS_INSTANCE_STATE;

static dds_return_t look(struct graph *graph, dds_entity_t reader, uint32_t instances, bool take) {
  const uint32_t mask = DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | instances;
  graph->samples[0] = NULL;
  return (take ? dds_take_mask : dds_read_mask)(reader, graph->samples, graph->infos, MOST_OTHERS, MOST_OTHERS, mask);
}

static void give_back(struct graph *graph, dds_entity_t reader, dds_return_t count) {
  if (count > 0) dds_return_loan(reader, graph->samples, count);
}

dds_return_t graph_others(struct graph *graph, bool publishers,
                          void (*visit)(void *, const char *topic, const char *type, bool reliable, bool transient_local),
                          void *context) {
  const dds_entity_t reader = publishers ? graph->publications : graph->subscriptions;
  /* Samples of endpoints that are gone are kept until they are taken. */
  give_back(graph, reader, look(graph, reader, GONE, true));
  const dds_return_t count = look(graph, reader, DDS_ALIVE_INSTANCE_STATE, false);
  for (dds_return_t i = 0; i < count; i++) {
    const dds_builtintopic_endpoint_t *other = graph->samples[i];
    if (!graph->infos[i].valid_data || other->topic_name == NULL || other->type_name == NULL ||
        memcmp(&other->participant_key, &graph->guid, sizeof graph->guid) == 0) {
      continue;
    }
    dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
    dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
    dds_duration_t blocking;
    dds_qget_reliability(other->qos, &reliability, &blocking);
    dds_qget_durability(other->qos, &durability);
    visit(context, other->topic_name, other->type_name, reliability == DDS_RELIABILITY_RELIABLE,
          durability >= DDS_DURABILITY_TRANSIENT_LOCAL);
  }
  give_back(graph, reader, count);
  return count < 0 ? count : DDS_RETCODE_OK;
}
