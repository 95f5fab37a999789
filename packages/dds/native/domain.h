/* DDS domains of this process: one each, whoever of its threads takes part, with the configuration of who came first. */
#ifndef FARPOINT_DOMAIN_H
#define FARPOINT_DOMAIN_H

#include <dds/dds.h>

struct domain;

/*
 * Joins, or starts, a domain. DDS_RETCODE_INCONSISTENT_POLICY: it runs with another configuration. Each success needs a
 * domain_leave; the last one stops it, all its threads included.
 */
dds_return_t domain_join(dds_domainid_t id, const char *configuration, struct domain **to);
void domain_leave(struct domain *domain);

#endif
