/*
 * A DDS type without compiled IDL: any name, no key; its samples are the bytes as sent (encapsulation header and CDR).
 * CycloneDDS asks a type how to store, send and compare samples; this type stores the bytes and never interprets them.
 */
#ifndef FARPOINT_RAW_TYPE_H
#define FARPOINT_RAW_TYPE_H

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/version.h>
#include <stddef.h>
#include <stdint.h>

/* The interface for custom types differs between minor versions. */
#if DDS_VERSION_MAJOR != 0 || DDS_VERSION_MINOR != 10
#error "CycloneDDS 0.10 is needed"
#endif

/* Encapsulation header: two bytes for the representation, two for options. */
enum { ENCAPSULATION_BYTES = 4 };

/* NULL if out of memory. */
struct ddsi_sertype *raw_type_new(const char *name);

/* Copies `size` bytes, including the header, to a sample with one reference; NULL if out of memory. */
struct ddsi_serdata *raw_sample_new(const struct ddsi_sertype *type, const uint8_t *bytes, size_t size);

struct raw_bytes {
  const uint8_t *at;
  size_t count;
};

/* The bytes of a sample of such a type. */
struct raw_bytes raw_sample_bytes(const struct ddsi_serdata *sample);

#endif
