/* What the readers and writers of others that are matched with one of ours say about themselves. */
#include <string.h>

#include "graph.h"

/* Maximum number that is read. */
enum { MOST_MATCHED = 256 };

dds_return_t endpoint_matched(const struct endpoint *endpoint, bool is_writer,
                              void (*visit)(void *, const dds_guid_t *guid, const char *user_data), void *context) {
  dds_instance_handle_t handles[MOST_MATCHED];
  dds_return_t count = is_writer ? dds_get_matched_subscriptions(endpoint->entity, handles, MOST_MATCHED)
                                 : dds_get_matched_publications(endpoint->entity, handles, MOST_MATCHED);
  if (count < 0) return count;
  if (count > MOST_MATCHED) count = MOST_MATCHED;
  for (dds_return_t i = 0; i < count; i++) {
    dds_builtintopic_endpoint_t *other = is_writer
                                             ? dds_get_matched_subscription_data(endpoint->entity, handles[i])
                                             : dds_get_matched_publication_data(endpoint->entity, handles[i]);
    /* It has disappeared since. */
    if (other == NULL) continue;
    void *data = NULL;
    size_t size = 0;
    const bool has_data = dds_qget_userdata(other->qos, &data, &size) && data != NULL;
    /* CycloneDDS adds a zero at the end. */
    visit(context, &other->key, has_data ? data : "");
    dds_free(data);
    dds_builtintopic_free_endpoint(other);
  }
  return DDS_RETCODE_OK;
}
