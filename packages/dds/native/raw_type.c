#include "raw_type.h"

#include <dds/ddsi/q_radmin.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct raw_sample {
  struct ddsi_serdata common;
  size_t size;
  /* Padded with zeros to a multiple of four, because CycloneDDS may send up to there. */
  uint8_t bytes[];
};

static size_t padded(size_t size) { return (size + 3) & ~(size_t)3; }

static const struct raw_sample *raw(const struct ddsi_serdata *common) { return (const struct raw_sample *)common; }

static struct raw_sample *allocate(const struct ddsi_sertype *type, enum ddsi_serdata_kind kind, size_t size) {
  /* Sizes in RTPS have 32 bits. */
  if (size > UINT32_MAX - 3) return NULL;
  struct raw_sample *sample = malloc(sizeof *sample + padded(size));
  if (sample == NULL) return NULL;
  ddsi_serdata_init(&sample->common, type, kind);
  /* Without a key, all samples belong to one instance. */
  sample->common.hash = type->serdata_basehash;
  sample->size = size;
  memset(sample->bytes + size, 0, padded(size) - size);
  return sample;
}

static bool equal_keys(const struct ddsi_serdata *a, const struct ddsi_serdata *b) { return true; }

static uint32_t sample_size(const struct ddsi_serdata *sample) { return (uint32_t)raw(sample)->size; }

/*
 * Fragments come in order of their beginning and may overlap. They come from the wire, so nothing is taken for granted:
 * a fragment that leaves a gap or exceeds the sample makes the whole sample invalid.
 */
static struct ddsi_serdata *from_fragments(const struct ddsi_sertype *type, enum ddsi_serdata_kind kind,
                                           const struct nn_rdata *fragment, size_t size) {
  struct raw_sample *sample = allocate(type, kind, size);
  if (sample == NULL) return NULL;
  size_t filled = 0;
  for (; fragment != NULL; fragment = fragment->nextfrag) {
    const size_t begin = fragment->min, end = fragment->maxp1;
    if (end <= filled) continue;
    if (begin > filled || end > size) break;
    const unsigned char *payload = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    memcpy(sample->bytes + filled, payload + (filled - begin), end - filled);
    filled = end;
  }
  if (filled == size) return &sample->common;
  free(sample);
  return NULL;
}

static struct ddsi_serdata *from_vectors(const struct ddsi_sertype *type, enum ddsi_serdata_kind kind,
                                         ddsrt_msg_iovlen_t count, const ddsrt_iovec_t *vectors, size_t size) {
  struct raw_sample *sample = allocate(type, kind, size);
  if (sample == NULL) return NULL;
  size_t filled = 0;
  for (size_t i = 0; i < (size_t)count && vectors[i].iov_len <= size - filled; i++) {
    memcpy(sample->bytes + filled, vectors[i].iov_base, vectors[i].iov_len);
    filled += vectors[i].iov_len;
  }
  if (filled == size) return &sample->common;
  free(sample);
  return NULL;
}

static struct ddsi_serdata *key_only(const struct ddsi_sertype *type) {
  struct raw_sample *sample = allocate(type, SDK_KEY, 0);
  return sample == NULL ? NULL : &sample->common;
}

static struct ddsi_serdata *from_key_hash(const struct ddsi_sertype *type, const struct ddsi_keyhash *hash) {
  return key_only(type);
}

/* Only raw_sample_new makes samples; those that CycloneDDS makes itself (when a writer ends) contain at most a key. */
static struct ddsi_serdata *from_sample(const struct ddsi_sertype *type, enum ddsi_serdata_kind kind,
                                        const void *sample) {
  return kind == SDK_DATA ? NULL : key_only(type);
}

static struct ddsi_serdata *to_untyped(const struct ddsi_serdata *sample) {
  struct ddsi_serdata *untyped = key_only(sample->type);
  if (untyped != NULL) untyped->type = NULL;
  return untyped;
}

static void copy_out(const struct ddsi_serdata *sample, size_t offset, size_t size, void *to) {
  memcpy(to, raw(sample)->bytes + offset, size);
}

static struct ddsi_serdata *lend(const struct ddsi_serdata *sample, size_t offset, size_t size, ddsrt_iovec_t *to) {
  to->iov_base = (void *)(raw(sample)->bytes + offset);
  to->iov_len = (ddsrt_iov_len_t)size;
  return ddsi_serdata_ref(sample);
}

static void give_back(struct ddsi_serdata *sample, const ddsrt_iovec_t *lent) { ddsi_serdata_unref(sample); }

/* Nothing reads these as C structures. */
static bool to_structure(const struct ddsi_serdata *sample, void *to, void **buffer, void *end) { return false; }

static bool untyped_to_structure(const struct ddsi_sertype *type, const struct ddsi_serdata *sample, void *to,
                                 void **buffer, void *end) {
  return true;
}

static void free_sample(struct ddsi_serdata *sample) { free(sample); }

static size_t print(const struct ddsi_sertype *type, const struct ddsi_serdata *sample, char *to, size_t size) {
  const int length = snprintf(to, size, "(%zu bytes)", raw(sample)->size);
  return length < 0 ? 0 : (size_t)length;
}

static void key_hash(const struct ddsi_serdata *sample, struct ddsi_keyhash *to, bool md5) { memset(to, 0, sizeof *to); }

static const struct ddsi_serdata_ops sample_operations = {
    .eqkey = equal_keys,
    .get_size = sample_size,
    .from_ser = from_fragments,
    .from_ser_iov = from_vectors,
    .from_keyhash = from_key_hash,
    .from_sample = from_sample,
    .to_ser = copy_out,
    .to_ser_ref = lend,
    .to_ser_unref = give_back,
    .to_sample = to_structure,
    .to_untyped = to_untyped,
    .untyped_to_sample = untyped_to_structure,
    .free = free_sample,
    .print = print,
    .get_keyhash = key_hash,
};

static void free_type(struct ddsi_sertype *type) {
  ddsi_sertype_fini(type);
  free(type);
}

static void zero_structures(const struct ddsi_sertype *type, void *samples, size_t count) {}

static void resize_structures(void **pointers, const struct ddsi_sertype *type, void *old, size_t old_count,
                              size_t count) {
  for (size_t i = 0; i < count; i++) pointers[i] = NULL;
}

static void free_structures(const struct ddsi_sertype *type, void **pointers, size_t count, dds_free_op_t what) {}

/* Types with the same name are equal, because they contain nothing else. */
static bool equal_types(const struct ddsi_sertype *a, const struct ddsi_sertype *b) { return true; }
static uint32_t type_hash(const struct ddsi_sertype *type) { return 0; }

static const struct ddsi_sertype_ops type_operations = {
    .version = ddsi_sertype_v0,
    .free = free_type,
    .zero_samples = zero_structures,
    .realloc_samples = resize_structures,
    .free_samples = free_structures,
    .equal = equal_types,
    .hash = type_hash,
};

struct ddsi_sertype *raw_type_new(const char *name) {
  struct ddsi_sertype *type = calloc(1, sizeof *type);
  if (type == NULL) return NULL;
  ddsi_sertype_init_flags(type, name, &type_operations, &sample_operations, DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1 | DDS_DATA_REPRESENTATION_FLAG_XCDR2;
  return type;
}

struct ddsi_serdata *raw_sample_new(const struct ddsi_sertype *type, const uint8_t *bytes, size_t size) {
  struct raw_sample *sample = allocate(type, SDK_DATA, size);
  if (sample == NULL) return NULL;
  memcpy(sample->bytes, bytes, size);
  return &sample->common;
}

struct raw_bytes raw_sample_bytes(const struct ddsi_serdata *sample) {
  return (struct raw_bytes){.at = raw(sample)->bytes, .count = raw(sample)->size};
}
