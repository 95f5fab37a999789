/*
 * A DDS type that nobody compiled: any name, no key, its samples the bytes as they travel (encapsulation header and CDR).
 * CycloneDDS asks a type how to keep, send and compare samples; these keep the bytes and never look inside.
 */
#ifndef FARPOINT_RAW_TYPE_H
#define FARPOINT_RAW_TYPE_H

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/version.h>
#include <stddef.h>
#include <stdint.h>

/* The interface for types of one's own differs from one minor version to the next. */
#if DDS_VERSION_MAJOR != 0 || DDS_VERSION_MINOR != 10
#error "CycloneDDS 0.10 is needed"
#endif

/* Encapsulation header: two bytes that name the representation, two of options. */
enum { ENCAPSULATION_BYTES = 4 };

/* NULL where there is no memory. */
struct ddsi_sertype *raw_type_new(const char *name);

/* A copy of `size` bytes, header included, as a sample with one reference; NULL where there is no memory. */
struct ddsi_serdata *raw_sample_new(const struct ddsi_sertype *type, const uint8_t *bytes, size_t size);

struct raw_bytes {
  const uint8_t *at;
  size_t count;
};

/* Bytes of a sample of such a type. */
struct raw_bytes raw_sample_bytes(const struct ddsi_serdata *sample);

#endif
