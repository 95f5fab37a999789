#include "domain.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

struct domain {
  dds_domainid_t id;
  char *configuration;
  dds_entity_t entity;
  unsigned members;
  struct domain *next;
};

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct domain *domains;

static dds_return_t start(dds_domainid_t id, const char *configuration, struct domain **to) {
  struct domain *domain = calloc(1, sizeof *domain);
  if (domain == NULL) return DDS_RETCODE_OUT_OF_RESOURCES;
  domain->id = id;
  domain->configuration = strdup(configuration);
  if (domain->configuration == NULL) {
    free(domain);
    return DDS_RETCODE_OUT_OF_RESOURCES;
  }
  domain->entity = dds_create_domain(id, configuration);
  if (domain->entity < 0) {
    const dds_return_t failure = domain->entity;
    free(domain->configuration);
    free(domain);
    return failure;
  }
  domain->members = 1;
  domain->next = domains;
  domains = domain;
  *to = domain;
  return DDS_RETCODE_OK;
}

dds_return_t domain_join(dds_domainid_t id, const char *configuration, struct domain **to) {
  dds_return_t result = DDS_RETCODE_OK;
  pthread_mutex_lock(&lock);
  struct domain *domain = domains;
  while (domain != NULL && domain->id != id) domain = domain->next;
  if (domain == NULL) {
    result = start(id, configuration, to);
  } else if (strcmp(domain->configuration, configuration) != 0) {
    result = DDS_RETCODE_INCONSISTENT_POLICY;
  } else {
    domain->members++;
    *to = domain;
  }
  pthread_mutex_unlock(&lock);
  return result;
}

void domain_leave(struct domain *domain) {
  pthread_mutex_lock(&lock);
  if (--domain->members == 0) {
    struct domain **link = &domains;
    while (*link != domain) link = &(*link)->next;
    *link = domain->next;
    dds_delete(domain->entity);
    free(domain->configuration);
    free(domain);
  }
  pthread_mutex_unlock(&lock);
}
