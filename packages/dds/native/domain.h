/*
 * DDS domains of this process: one for each id, shared by all threads, with the configuration of the thread that came
 * first.
 */
#ifndef FARPOINT_DOMAIN_H
#define FARPOINT_DOMAIN_H

#include <dds/dds.h>

struct domain;

/*
 * Joins a domain, or starts it. Returns DDS_RETCODE_INCONSISTENT_POLICY if it runs with a different configuration. Each
 * success requires a domain_leave; the last one stops the domain with all its threads.
 */
dds_return_t domain_join(dds_domainid_t id, const char *configuration, struct domain **to);
void domain_leave(struct domain *domain);

#endif
